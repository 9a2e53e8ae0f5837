// What a robot's base and its host report, and what the host is to do, in the terms of VDA 5050 2.1 (6.10.6).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace kb::vda5050 {

inline constexpr std::array<std::string_view, 4> kStops{"NONE", "AUTOACK", "MANUAL", "REMOTE"};
inline constexpr std::array<std::string_view, 5> kModes{"AUTOMATIC", "SEMIAUTOMATIC", "MANUAL", "SERVICE", "TEACHIN"};

/// Something that the host is to do besides driving.
struct HostAction {
  std::string id, type;
  std::string parameters;     ///< JSON, an object in one line: `{"height":1.2}`; empty: `{}`
  bool pause = false;         ///< it is to be interrupted until this is false again
  bool cancel = false;        ///< it is to be given up, if that is possible
};

/// The host's report on it.
struct HostActionState {
  std::string id, status;     ///< `running`, `paused`, `finished` or `failed`
  std::string result = {};    ///< for the master; may be empty
};

/// The defaults hold for what the base does not report.
struct Condition {
  std::optional<double> battery_percent;   ///< 0 to 100; nothing: unknown
  bool charging = false;
  std::string e_stop{kStops[0]};           ///< of kStops: how the present emergency stop is released
  bool field_violation = false;            ///< something is in its protective field
  std::string mode{kModes[0]};             ///< of kModes; in the first two the robot drives by itself
};

}  // namespace kb::vda5050
