// `kbc drive --orders`: everything besides the conversation with the robot when a master gives the missions.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/kbc/drive_ground.h"
#include "tools/kbc/layout/layout.h"
#include "tools/kbc/order_desk.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/vda5050/link/link.h"

namespace kb::cli {

struct OrderOptions {
  vda5050::LinkOptions link;           ///< if its `orders` is empty, no master gives missions
  std::vector<std::string> skills;   ///< `pick`, `wait=5s`
  std::string visualization;         ///< `500ms`: how often that message is sent; `0`: never; empty: every second to a broker, never to a file
  std::string map;                   ///< the id of the map that positions are on; empty: that of the layout, else the name of the knowledge base's first map
  std::string imported_from;         ///< `lif:yard.json`, whose nodes and edges orders name; empty: they name those of the knowledge base
  layout::Choice choice;             ///< what is taken of that file
  std::string prefix = "LM";         ///< put before ids that cannot be names

  [[nodiscard]] bool given() const { return !link.orders.empty(); }
};
/// `messages`: the file for the messages between master and vehicle.
void add_order_options(CLI::App& app, OrderOptions& options, std::string& messages);

/// An OrderDesk with all that it needs.
class Orders {
 public:
  /// `missions`, `ground`, `scene`, `exchange` and `messages` must outlive it. Null if the link cannot be made, or the layout is not that of the
  /// knowledge base (reported). `messages`: where messages are written to; may be null.
  [[nodiscard]] static std::unique_ptr<Orders> open(const OrderOptions& options, const OrderMissions& missions, const DriveGround& ground, const Scene& scene,
                                                    wire::Exchange& exchange, trace::OutputFile* messages, Session& session);

  /// To be called after each line that was understood.
  void step() { desk_->step(), tell(); }
  /// Whether there may be something to do while the robot is silent; `wait` must then be called.
  [[nodiscard]] bool live() const { return link_->live(); }
  /// To be called while nothing comes, or nothing that can be understood.
  void wait(std::int64_t silent_us) { desk_->wait(silent_us), tell(); }
  /// Takes leave of the master.
  void end() { desk_->leave(), tell(); }

 private:
  Orders(std::string from, Session& session) : session_(session), from_(std::move(from)) {}
  void tell();

  Session& session_;
  std::string from_;   // the broker or file that orders come from
  std::unique_ptr<vda5050::Plant> plant_;
  std::optional<vda5050::Vehicle> vehicle_;
  std::unique_ptr<vda5050::Link> link_;
  std::optional<OrderDesk> desk_;
};

}  // namespace kb::cli
