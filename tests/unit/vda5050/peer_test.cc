// The same orders as another implementation was given (data/vda5050/peer_scenarios.jsonl): it says the same, but where this says why not.
#include "tests/unit/vda5050/yard.h"

#include <fstream>
#include <map>

namespace kb::vda5050 {
namespace {

class Peer : public Yard {
 protected:
  /// As the digests of the peer's states.
  Json digest() const {
    std::string actions;
    for (const Json& one : state["actionStates"]) actions += (actions.empty() ? "" : " ") + one["actionStatus"].get<std::string>();
    return {{"orderId", state["orderId"]}, {"orderUpdateId", state["orderUpdateId"]}, {"lastNodeId", state["lastNodeId"]}, {"left", left()}, {"errors", errors()}, {"actions", actions}};
  }
};

TEST_F(Peer, SaysTheSameAsAnotherVehicle) {
  // By the number of the scenario: what our vehicle says in place of what the other one did.
  const std::map<char, Json> otherwise{
      // Another order while one is driven: by figure 8 it is no update, so it is no orderUpdateError.
      {'3', {{"errors", "orderError"}}},
      // A list called `actions` is what the standard says; the other one knows only the older name. It also tells no states of actions that failed at once.
      {'a', {{"errors", "orderUpdateError noRouteError validationError orderError noOrderToCancel noOrderToCancel"}, {"actions", "FAILED FAILED"}}},
      // The complaints end with the order that is taken (6.6.4).
      {'b', {{"errors", ""}}},
      // The other one stops between two nodes, ours at the next one (6.6.3).
      {'c', {{"errors", ""}, {"lastNodeId", "n4"}}},
  };
  std::ifstream file(KB_PROJECT_ROOT "/data/vda5050/peer_scenarios.jsonl");
  row.map = "local";
  row.knows_places = false;   // the other vehicle believes any
  progress.here = "L1";
  look();
  char scenario = '0';
  int compared = 0;
  for (std::string line; std::getline(file, line);) {
    const Json entry = Json::parse(line);
    if (entry.contains("note")) {
      const std::string number = entry["note"].get<std::string>().substr(0, 2);
      scenario = number == "11" ? 'a' : number == "12" ? 'b' : number == "10" ? '9' : number[0];
    } else if (entry.contains("say")) {
      if (entry["say"] == "instantActions" && scenario == 'b') scenario = 'c', set_off();
      say(entry["say"], entry["message"]);
    } else {
      if (scenario == '3' || scenario == '6') drive();
      if (scenario == 'c') pass(), stop();
      Json expected = entry["peer"];
      if (const auto found = otherwise.find(scenario); found != otherwise.end()) expected.update(found->second);
      EXPECT_EQ(digest(), expected) << "scenario " << scenario;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 11);
}

}  // namespace
}  // namespace kb::vda5050
