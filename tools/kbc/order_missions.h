// The missions of orders: a way through a knowledge base that has none of its own becomes a route, compiled, for a mind that is driving.
//
// note [missions of orders]
// A way is compiled as if somebody had written it down below the knowledge base: a command, and a route of that way. All missions have the same names for
// these, so that what a mind knows of one goes over to the next by name: a way that has grown is driven on without a stop. Of such a way the part that is
// behind the robot is left out, and the legs keep their numbers. Where a robot can turn
// round on a road (std.retreat) there is a second button, which makes it do so when its mission begins.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sim/mind/knowledge.h"
#include "tools/kbc/remembered_files.h"
#include "tools/kbc/support.h"
#include "tools/kbc/vda5050/vehicle.h"

namespace kb::cli {

/// A way, compiled. It does not move: its parts refer to one another.
struct OrderMission {
  std::unique_ptr<driver::Compilation> compiled;
  std::unique_ptr<tables::LoadedImage> image;
  sim::Knowledge knowledge;
};

class OrderMissions {
 public:
  /// Reads the roads of `path`. `stub`: see sim::prepare. Nothing if it cannot be compiled or has no landmarks (reported). `session` must outlive it.
  [[nodiscard]] static std::optional<OrderMissions> open(const std::string& path, std::vector<std::string> stub, Session& session);

  /// The knowledge base with a mission that nobody begins, for a mind that waits for its first order. Not ok if anything is wrong (reported). Files are
  /// as they were when this was asked first.
  [[nodiscard]] std::unique_ptr<driver::Compilation> idle() const;
  /// The mission of a task, which has a way; null if it cannot be driven (reported). As long as compiling the knowledge base takes.
  [[nodiscard]] std::unique_ptr<OrderMission> make(const vda5050::Task& task) const;
  /// The same of what was compiled already, and prepared.
  [[nodiscard]] std::unique_ptr<tables::LoadedImage> image_of(const driver::Compilation& compiled) const;

  /// The route of each mission.
  [[nodiscard]] const std::string& route() const { return route_; }
  /// The button that begins a mission.
  [[nodiscard]] const std::string& command() const { return command_; }
  /// The one that makes it turn round, pressed together with that; empty: it cannot.
  [[nodiscard]] const std::string& turn_command() const { return turn_command_; }
  /// Which visit of its task a leg leads to, those that it passed counted; nothing: the leg is of no such route, but of a way back or round.
  [[nodiscard]] std::optional<std::size_t> visit_of(std::string_view leg, vda5050::Start start) const;

 private:
  OrderMissions(std::string path, std::vector<std::string> stub, Session& session)
      : path_(std::move(path)), stub_(std::move(stub)), session_(&session), files_(std::make_unique<RememberedFiles>(session.files())) {}
  [[nodiscard]] std::unique_ptr<driver::Compilation> compiled(std::span<const vda5050::Visit> way, std::size_t first_leg = 0) const;

  std::string path_;
  std::vector<std::string> stub_;
  Session* session_;
  std::unique_ptr<RememberedFiles> files_;
  std::string route_, command_, turn_command_;               // names that nothing else has
  std::string first_;                                        // any landmark
  std::unordered_map<std::string, std::string> map_of_;      // by landmark
};

}  // namespace kb::cli
