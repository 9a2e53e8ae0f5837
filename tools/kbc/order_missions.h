// The missions of orders: compiles a way through a knowledge base that has no routes of its own into a route, for a mind that is driving.
//
// note [missions of orders]
// A way is compiled as if it were written at the end of the knowledge base: a command, and a route of that way. All missions use the same
// names for these, so that the mind's state carries over to the next by name: a way that has grown is driven on without a stop. The part
// of such a way behind the robot is left out, and the legs keep their numbers. If a robot can turn round on a road (std.retreat), there
// is a second button, which makes it do so when its mission begins.
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

/// A compiled way. It does not move, as its parts refer to one another.
struct OrderMission {
  std::unique_ptr<driver::Compilation> compiled;
  std::unique_ptr<tables::LoadedImage> image;
  sim::Knowledge knowledge;
};

class OrderMissions {
 public:
  /// Reads the roads of `path`. `stub`: see sim::prepare. Nothing if it cannot be compiled or has no landmarks (reported). `session` must
  /// outlive it.
  [[nodiscard]] static std::optional<OrderMissions> open(const std::string& path, std::vector<std::string> stub, Session& session);

  /// The knowledge base with a mission that is never begun, for a mind that waits for its first order. Not ok if anything is wrong
  /// (reported). Files are as they were at the first call.
  [[nodiscard]] std::unique_ptr<driver::Compilation> idle() const;
  /// The mission of a task, which has a way; null if it cannot be driven (reported). Takes as long as compiling the knowledge
  /// base.
  [[nodiscard]] std::unique_ptr<OrderMission> make(const vda5050::Task& task) const;
  /// The image of what was compiled already.
  [[nodiscard]] std::unique_ptr<tables::LoadedImage> image_of(const driver::Compilation& compiled) const;

  /// The route of each mission.
  [[nodiscard]] const std::string& route() const { return route_; }
  /// The button that begins a mission.
  [[nodiscard]] const std::string& command() const { return command_; }
  /// The button that makes it turn round, pressed together with the command; empty: it cannot.
  [[nodiscard]] const std::string& turn_command() const { return turn_command_; }
  /// The visit of its task that a leg leads to, counting those already passed; nothing if the leg belongs to a retreat or a detour.
  [[nodiscard]] std::optional<std::size_t> visit_of(std::string_view leg, vda5050::Start start) const;

 private:
  OrderMissions(std::string path, std::vector<std::string> stub, Session& session)
      : path_(std::move(path)), stub_(std::move(stub)), session_(&session), files_(std::make_unique<RememberedFiles>(session.files())) {}
  [[nodiscard]] std::unique_ptr<driver::Compilation> compiled(std::span<const vda5050::Visit> way, std::size_t first_leg = 0) const;

  std::string path_;
  std::vector<std::string> stub_;
  Session* session_;
  std::unique_ptr<RememberedFiles> files_;
  std::string route_, command_, turn_command_;               // unique names
  std::string first_;                                        // any landmark
  std::unordered_map<std::string, std::string> map_of_;      // by landmark
};

}  // namespace kb::cli
