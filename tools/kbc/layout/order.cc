// Orders of VDA 5050, by which the master of a fleet tells a vehicle where to go: 2.x, and 3.x, whose edges do not name their ends.
#include <fmt/format.h>

#include <algorithm>

#include "tools/kbc/layout/edges.h"
#include "tools/kbc/layout/json.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/layout/place_index.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

// note [base and horizon]
// An order is a chain of nodes and edges, numbered together by `sequenceId`. The master releases a first part of it, the base, and
// may still change the rest, the horizon. Which edges leave and reach a node is told by the chain alone; in 2.x the edges say so too.

/// A node or an edge of the chain.
struct Link {
  const Json* json;
  const Json* id;
  double sequence;
  bool node, released;

  [[nodiscard]] std::string name() const { return fmt::format("{} `{}`", node ? "node" : "edge", id->text); }
};

class OrderReader {
 public:
  OrderReader(const Map& map, Adaptations& adaptations, diagnostics::Diagnostics& diagnostics)
      : layout_(map.layout), edges_(map), adaptations_(adaptations), diagnostics_(diagnostics) {}

  std::optional<Mission> run(const Json& root) {
    const Fields order(root, "the order", diagnostics_);
    const Json* id = order.want("orderId", Json::Kind::kString);
    if (const Json* version = order.may("version", Json::Kind::kString); version != nullptr && !is_known(version->text)) {
      refuse(*version, fmt::format("its version is {}, and only 2.x and 3.x are read", version->text));
      return std::nullopt;
    }
    const double update = order.count("orderUpdateId");
    read_links(order.objects("nodes"), "nodeId", true);
    read_links(order.objects("edges"), "edgeId", false);
    if (diagnostics_.failed() || !is_chain(root)) return std::nullopt;
    Mission mission;
    mission.order = fmt::format("The order {}, update {}: by its edges alone, ways round are its master's to plan.", id->text, update);
    for (std::size_t i = 0; i < links_.size() && links_[i].released; ++i) {
      if (links_[i].node) visit(links_[i], mission);
      else leave(i, mission);
      note_what_is_left_out(links_[i]);
    }
    return diagnostics_.failed() ? std::nullopt : std::optional(std::move(mission));
  }

 private:
  void read_links(const std::vector<const Json*>& parts, std::string_view id_key, bool node) {
    for (const Json* json : parts) {
      const Json* id = Fields(*json, node ? "the node" : "the edge", diagnostics_).want(id_key, Json::Kind::kString);
      if (id == nullptr) continue;
      Link link{json, id, 0.0, node, false};
      const Fields fields(*json, link.name(), diagnostics_);
      link.sequence = fields.count("sequenceId");
      const Json* released = fields.want("released", Json::Kind::kBool);
      link.released = released != nullptr && released->text == "true";
      const bool behind = !links_.empty() && links_.back().node == node && links_.back().sequence > link.sequence;
      if (behind) refuse(*id, fmt::format("{} stands behind {}, and has a lower sequenceId", link.name(), links_.back().name()));
      links_.push_back(link);
    }
  }

  /// `2.1.0`, `3.0`.
  static bool is_known(std::string_view version) { return version.starts_with("2.") || version.starts_with("3."); }

  bool refuse(const Json& at, const std::string& why) {
    diagnostics_.report(Kind::kOrderNoChain, at.span, {why});
    return false;
  }

  // Puts nodes and edges in one sequence and checks that they are node, edge, node, ..., node, with all that is released first.
  bool is_chain(const Json& root) {
    std::stable_sort(links_.begin(), links_.end(), [](const Link& a, const Link& b) { return a.sequence < b.sequence; });
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Link& link = links_[i];
      if (i == 0 && !link.node) return refuse(*link.id, fmt::format("it begins with {}", link.name()));
      if (i == 0) continue;
      const Link& before = links_[i - 1];
      if (link.sequence == before.sequence) return refuse(*link.id, fmt::format("{} and {} have the same sequenceId", before.name(), link.name()));
      if (link.node == before.node) return refuse(*link.id, fmt::format("{} follows {}", link.name(), before.name()));
      if (link.released && !before.released) return refuse(*link.id, fmt::format("{} is released, and {} before it is not", link.name(), before.name()));
    }
    const auto horizon = std::find_if(links_.begin(), links_.end(), [](const Link& link) { return !link.released; });
    if (horizon == links_.begin()) return refuse(root, "no node of it is released");
    const Link& last = *(horizon - 1);
    if (!last.node) return refuse(*last.id, fmt::format("what is released ends with {}", last.name()));
    if (!links_.back().node) return refuse(*links_.back().id, fmt::format("it ends with {}", links_.back().name()));
    for (std::size_t i = 1; i + 1 < links_.size(); i += 2) {
      if (!is_end(links_[i], "startNodeId", links_[i - 1]) || !is_end(links_[i], "endNodeId", links_[i + 1])) return false;
    }
    for (auto at = horizon; at != links_.end(); ++at) {
      if (at->node) adaptations_.note("node of the order that is not released: left out", at->id->span);
    }
    return true;
  }

  void visit(const Link& link, Mission& mission) {
    const auto index = edges_.place(link.id->text);
    if (!index) return void(diagnostics_.report(Kind::kLayoutUnknownPlace, link.id->span, {link.id->text}));
    if (mission.visits.empty() || mission.visits.back().place != *index) mission.visits.push_back({*index, 0});
    const Place& place = layout_.places[*index];
    const Json* position = Fields(*link.json, link.name(), diagnostics_).may("nodePosition", Json::Kind::kObject);
    if (position == nullptr) return;
    const Fields fields(*position, "the position", diagnostics_);
    const Point at{fields.number("x"), fields.number("y")};
    note_left_out(*position, {"theta", "allowedDeviationXY", "allowedDeviationTheta"});
    if (!ends_at(at, &place)) adaptations_.note("node that the order puts elsewhere: it is where the layout has it", position->span);
    const Json* map = fields.may("mapId", Json::Kind::kString);
    const bool other = map != nullptr && !place.map.empty() && place.id == link.id->text && map->text != place.map;
    if (other) adaptations_.note("node that the order puts on another map: it is on that of the layout", map->span);
  }

  // Drives edge `at`: gives the visit before it the side by which its road leaves, and adds visits of the places it runs over.
  void leave(std::size_t at, Mission& mission) {
    const Link &edge = links_[at], &from = links_[at - 1], &to = links_[at + 1];
    const auto begin = edges_.place(from.id->text), end = edges_.place(to.id->text);
    if (!begin || !end || mission.visits.empty()) return;   // has been reported, or will be
    const auto drive = edges_.find(edge.id->text, *begin, *end);
    if (!drive) {
      diagnostics_.report(Kind::kOrderNoWay, edge.id->span, {edge.id->text, from.id->text, to.id->text})
          .suggest(edges_.instead_of(edge.id->text, *begin, *end));
      return;
    }
    if (drive->twice) adaptations_.note("edge that the layout has twice, on different ways: the first is taken", edge.id->span);
    const double limit_m_s = limit_on(edge);
    if (drive->visits.empty()) return adaptations_.note("edge of the order between places at one spot: there is nothing to drive", edge.id->span);
    mission.visits.back().exit = drive->visits.front().exit;
    const auto first = static_cast<std::ptrdiff_t>(mission.visits.size()) - 1;
    mission.visits.insert(mission.visits.end(), drive->visits.begin() + 1, drive->visits.end());
    std::for_each(mission.visits.begin() + first, mission.visits.end(), [&](Visit& visit) { visit.limit_m_s = limit_m_s; });
  }

  double limit_on(const Link& edge) {
    const Json* speed = Fields(*edge.json, edge.name(), diagnostics_).may("maxSpeed", Json::Kind::kNumber);
    if (speed == nullptr) return 0.0;
    if (!may_drive(speed->number)) diagnostics_.report(Kind::kLayoutBarred, speed->span, {edge.id->text, fmt::format("its `maxSpeed` is {}", speed->text)});
    return limit_of(speed->number);
  }

  bool is_end(const Link& edge, std::string_view key, const Link& node) {
    const Json* end = Fields(*edge.json, edge.name(), diagnostics_).may(key, Json::Kind::kString);
    return end == nullptr || end->text == node.id->text ||
           refuse(*end, fmt::format("{} of {} is `{}`, and beside it stands {}", key, edge.name(), end->text, node.name()));
  }

  void note_left_out(const Json& object, std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
      if (const Json* part = object.find(key)) adaptations_.note(fmt::format("{} of the order: left out", key), part->span);
    }
  }
  void note_what_is_left_out(const Link& link) {
    note_left_out(*link.json, {"trajectory", "corridor", "orientation", "direction", "maxRotationSpeed", "rotationAllowed",
                               "maxHeight", "minHeight"});
    if (link.json->find("actions") == nullptr) return;
    for (const Json* action : Fields(*link.json, link.name(), diagnostics_).objects("actions")) {
      adaptations_.note("action of the order: left out", action->span);
    }
  }

  const Layout& layout_;
  Edges edges_;
  Adaptations& adaptations_;
  diagnostics::Diagnostics& diagnostics_;
  std::vector<Link> links_;
};

}  // namespace

std::optional<Mission> mission_of_order(const source::Sources& sources, source::FileId file, const Map& map, Adaptations& adaptations,
                                        diagnostics::Diagnostics& diagnostics) {
  const auto root = read_json(sources, file, diagnostics);
  if (!root) return std::nullopt;
  return OrderReader(map, adaptations, diagnostics).run(*root);
}

}  // namespace kb::layout
