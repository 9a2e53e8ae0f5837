// Prints which perceived facts can be taken for one another.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "compiler/analysis/confusion.h"

namespace kb::analysis {

using program::Program;

std::string print_confusion(const Program& program) {
  Confusions confusions(program);
  const auto& perceived = program.perception.perceived;
  struct Line { std::string who; double degree; std::string where; };
  std::vector<Line> lines;
  std::size_t widest = 0;
  for (std::size_t i = 0; i < perceived.size(); ++i) {
    for (std::size_t k = i + 1; k < perceived.size(); ++k) {
      if (!confusions.share_readings(perceived[i].fact, perceived[k].fact)) continue;
      Confusion c = confusions.between(perceived[i].fact, perceived[k].fact);
      lines.push_back({fmt::format("{}, {}", program[c.first].name, program[c.second].name), c.degree, std::move(c.readings)});
      widest = std::max(widest, lines.back().who.size());
    }
  }
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.degree > b.degree; });
  std::string out;
  for (const Line& line : lines) {
    out += fmt::format("{:<{}}  {:5.2f}{}{}\n", line.who, widest, line.degree, line.degree > 0.0 ? "  where " : "", line.degree > 0.0 ? line.where : "");
  }
  return out;
}

}  // namespace kb::analysis
