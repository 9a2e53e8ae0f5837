// Kinds of strategies, which decide colours, dashes and legends.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/recording.h"

namespace kb::sim::report {

/// How a kind is drawn: in colours that remain distinct for readers who cannot tell red from green (Okabe and Ito, 2008), and with a
/// dash pattern of its own for readers who see no colours.
struct Look {
  std::string_view light;   ///< on white
  std::string_view dark;    ///< on black
  std::string_view dash;    ///< SVG's stroke-dasharray; "" solid
};
inline constexpr std::array<Look, 7> kLooks = {{{"#0072b2", "#5cb3ef", ""},
                                                {"#d55e00", "#ff9a4d", "7 3"},
                                                {"#a2447f", "#e79fc9", "3 2"},
                                                {"#00785a", "#3fd0a6", "10 3 2 3"},
                                                {"#8a6a00", "#f0c040", "4 2"},
                                                {"#4b4ba8", "#a9a9ff", "12 4"},
                                                {"#1f2328", "#e8e8e8", "16 3"}}};
/// Used where no strategy runs.
inline constexpr Look kNoLook{"#777777", "#8a8f98", "1 4"};

/// The kinds of strategies in the order of their first cell. A kind is the part of a name before the first `.` or `[`:
/// `Move.mark` and `Move.dist` are of one kind.
struct Kinds {
  std::vector<std::string> names;
  std::vector<std::int32_t> of_cell;   ///< by cell; -1: no strategy
};
[[nodiscard]] Kinds strategy_kinds(const MindNames& names);
[[nodiscard]] const Look& look_of(std::int32_t kind);

}  // namespace kb::sim::report
