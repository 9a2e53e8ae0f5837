// Table 1 of Kargin and Ivaniuk in closed loop: what the paper prints for its robot happens to ours, in the same order.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

std::vector<std::vector<std::string>> fields(const std::string& text, char separator) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, separator);) rows.back().push_back(field);
  }
  return rows;
}

/// Rows of the table that std.navigation does not have, or has in another way (examples/01_route1/paper.kb says which):
/// the paper's robot spends the exit when it has chosen the manoeuvre, drops the road strategy when it recognises a landmark,
/// calls the road ahead unsafe where ours calls it closed, and takes the marking for the end of an obstacle.
const std::set<std::string> kNotOurs{"satfObsti_mark", "satfManeuver_mark", "fSafe", "satfOut_E", "satfOut_S", "satfOut_W"};

/// The cells of a drive, frame by frame.
class Reader {
 public:
  Reader(const Recording& recording, const Laboratory& lab) : recording_(recording), lab_(lab) {
    std::vector<float> now;
    for (const auto& cell : recording.names.cells) now.push_back(cell.initial);
    for (const Frame& frame : recording.frames) {
      for (const Frame::Change& change : frame.changed) now[change.cell] = change.value;
      cells_.push_back(now);
    }
  }
  /// Whether the row of the table that is `kind;cell` is positive in a frame.
  [[nodiscard]] bool positive(std::size_t frame, const std::string& kind, const std::string& name) const {
    const auto cell = static_cast<std::size_t>(lab_.knowledge->find(name));
    if (kind == "strategy") return recording_.frames[frame].strategy == static_cast<std::int32_t>(cell);
    if (kind != "sat") return cells_[frame][cell] > 0.5f;
    for (const program::CellId satellite : lab_.compiled->program.cells[cell].satellites) {
      if (cells_[frame][program::index(satellite)] > 0.5f) return true;
    }
    return false;
  }
  /// Positive, and not in the frame before.
  [[nodiscard]] bool rises(std::size_t frame, const std::string& kind, const std::string& name) const {
    return positive(frame, kind, name) && (frame == 0 || !positive(frame - 1, kind, name));
  }
  [[nodiscard]] std::size_t frames() const { return cells_.size(); }

 private:
  const Recording& recording_;
  const Laboratory& lab_;
  std::vector<std::vector<float>> cells_;
};

TEST(Table1, ItsColumnsHappenInOrderInClosedLoop) {
  const auto lab = Laboratory::of_file("examples/04_simulator/route1.kb");
  Recording recording;
  const Summary summary = lab->drive(lab->scenario(project_file("examples/04_simulator/detour.toml")), &recording);
  ASSERT_EQ(describe(summary), "arrived at LM15");
  const auto table = fields(project_file("examples/01_route1/table1.csv"), ',');
  std::map<std::string, std::pair<std::string, std::string>> meaning;
  for (const auto& row : fields(project_file("examples/01_route1/table1.rows.csv"), ';')) meaning[row.at(0)] = {row.at(1), row.at(2)};

  const Reader reader(recording, *lab);
  std::size_t at = 0, before_at = 0, edges = 0;
  std::map<std::string, std::size_t> looked_to;   // by row: the frame after its last edge
  for (std::size_t column = 1; column < table[0].size(); ++column) {
    // What becomes positive in this column, and is ours.
    std::vector<std::string> wanted;
    for (std::size_t r = 1; r < table.size(); ++r) {
      const bool now = std::stod(table[r][column]) > 0.0, before = column > 1 && std::stod(table[r][column - 1]) > 0.0;
      if (now && !before && !kNotOurs.contains(table[r][0])) wanted.push_back(table[r][0]);
    }
    // Each of them rises after its last time, and not before the column before has begun: what follows from a column may come
    // before the last of it. The column is over when all have risen.
    std::size_t last = at;
    for (const std::string& row : wanted) {
      std::size_t frame = std::max(before_at, looked_to[row]);
      while (frame < reader.frames() && !reader.rises(frame, meaning.at(row).first, meaning.at(row).second)) ++frame;
      EXPECT_LT(frame, reader.frames()) << "column " << table[0][column] << ": " << row << " does not happen after " << recording.frames[before_at].t_s << " s";
      if (frame == reader.frames()) continue;
      looked_to[row] = frame + 1;
      last = std::max(last, frame);
      ++edges;
    }
    before_at = std::exchange(at, last);
  }
  EXPECT_GT(edges, 50u);
}

}  // namespace
}  // namespace kb::sim::testing
