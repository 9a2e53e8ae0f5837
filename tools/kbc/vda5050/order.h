// A master's orders and instant actions as values (VDA 5050 2.1, 6.6.6 and 6.9), and the errors reported for those that are refused.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/kbc/vda5050/plant.h"

namespace kb::vda5050 {

// Anything larger is refused. The factsheet gives these limits to the master.
inline constexpr std::size_t kMostBytes = std::size_t{4} << 20;   ///< of a message
inline constexpr std::size_t kMostNodes = 10'000;                 ///< of an order, and of what is left to drive
inline constexpr std::size_t kMostActions = 10'000;               ///< of an order, and of all that are not over yet
inline constexpr std::size_t kMostInstants = 100;                 ///< of a message, and of all that are not over yet
inline constexpr std::size_t kLongestId = 256;                    ///< bytes of a name
inline constexpr double kNodeWithin_m = 0.5;                      ///< so far from the position that an order gives it a node may lie, or as far as the order allows
inline constexpr std::size_t kLongestParameters = std::size_t{64} << 10;   ///< bytes of an action's parameters, which a host gets in one line

/// Whether an action allows driving and other actions beside it (6.12).
enum class Blocking : std::uint8_t { kNone, kSoft, kHard };

struct Action {
  std::string id, type;
  Blocking blocking = Blocking::kNone;
  std::string parameters = "{}";   ///< JSON, an object
  friend bool operator==(const Action&, const Action&) = default;
};

/// Where a master thinks that a node lies.
struct NodePosition {
  double x_m = 0.0, y_m = 0.0;
  std::string map;                 ///< empty: not said
  double deviation_m = 0.0;        ///< `allowedDeviationXY`; 0: not said
  friend bool operator==(const NodePosition&, const NodePosition&) = default;
};

struct Node {
  std::string id;
  std::uint32_t sequence = 0;      ///< even
  bool released = false;           ///< it belongs to the base; else to the horizon
  std::vector<Action> actions;
  std::string landmark = {};       ///< as found by the plant
  std::optional<NodePosition> position = {};
  friend bool operator==(const Node&, const Node&) = default;
};

struct Edge {
  std::string id;
  std::uint32_t sequence = 0;      ///< odd
  bool released = false;
  std::string from, to;            ///< nodes
  std::vector<Action> actions;
  double limit_m_s = 0.0;          ///< `maxSpeed`; 0: it has none
  std::vector<Visit> way = {};     ///< as found by Plant::way
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// At least one node, and an edge between each two neighbours. The base has at least one node and comes before the horizon.
struct Order {
  std::string id;
  std::uint32_t update = 0;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<std::string> unused = {};   ///< fields on how to drive that are ignored: `edges.maxHeight`; each once
};

/// An error as in `state` (6.10.6). `references`: what it is about (7.1).
struct Complaint {
  std::string type, description;
  std::vector<std::pair<std::string, std::string>> references = {};
  bool fatal = false;
  friend bool operator==(const Complaint&, const Complaint&) = default;
};

}  // namespace kb::vda5050
