// The experiment of Kargin and Ivaniuk: the facts of their Table 1 go through the compiled knowledge base, and its cells
// are printed beside theirs.
//
//   example_route1 [FOLDER]     the folder that holds table1.csv and the other data; by default that of the sources
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "paper.kb.h"

namespace {

using Fields = std::vector<std::string>;

Fields split(const std::string& line, char separator) {
  Fields fields(1);
  for (const char c : line) {
    if (c == separator) fields.emplace_back();
    else fields.back() += c;
  }
  return fields;
}

/// The lines of a file as fields; comment lines are left out.
std::vector<Fields> read(const std::string& path, char separator) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<Fields> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') lines.push_back(split(line, separator));
  }
  return lines;
}

/// What the generated header declares, by name.
template <class E>
std::map<std::string, E> by_name(std::uint32_t count) {
  std::map<std::string, E> names;
  for (std::uint32_t i = 0; i < count; ++i) names[paper::name(static_cast<E>(i))] = static_cast<E>(i);
  return names;
}

/// Reads a cell of the running mind as the paper's table prints it.
class Reader {
 public:
  explicit Reader(const paper::Mind& mind) : mind_(mind) {}

  float read(const std::string& kind, const std::string& cell) const {
    if (kind == "fact") return mind_.value(facts_.at(cell));
    if (kind == "strategy") return mind_.ran(strategies_.at(cell)) ? 1.0f : -1.0f;
    if (kind == "satellite") return mind_.value(satellites_.at(cell));
    const auto fact = facts_.find(cell);
    if (fact != facts_.end()) return mind_.attended(fact->second) ? 1.0f : -1.0f;
    return mind_.value(satellites_.at("sat " + cell));
  }

 private:
  const paper::Mind& mind_;
  std::map<std::string, paper::Fact> facts_ = by_name<paper::Fact>(paper::Knowledge::kShape.facts);
  std::map<std::string, paper::Satellite> satellites_ = by_name<paper::Satellite>(paper::Knowledge::kShape.satellites);
  std::map<std::string, paper::Strategy> strategies_ = by_name<paper::Strategy>(paper::Knowledge::kShape.strategies);
};

/// Feeds every tick of the mission and reads all rows when a column of the table has been fed: ours[row][column].
std::vector<std::vector<float>> run(const std::string& folder, const std::vector<Fields>& rows, std::size_t columns) {
  const auto ticks = read(folder + "/mission.facts.csv", ',');
  std::map<std::size_t, std::size_t> column_of;
  for (const Fields& line : read(folder + "/table1.columns.csv", ',')) {
    if (line[0] != "tick") column_of.emplace(std::stoul(line[0]), column_of.size());
  }
  const auto facts_by_name = by_name<paper::Fact>(paper::Knowledge::kShape.facts);
  paper::Mind mind;
  paper::Facts facts;
  const Reader reader(mind);
  std::vector<std::vector<float>> ours(rows.size(), std::vector<float>(columns, 0.0f));
  for (std::size_t tick = 1; tick < ticks.size(); ++tick) {
    for (std::size_t i = 1; i < ticks[tick].size(); ++i) {
      const std::string& value = ticks[tick][i];
      facts.set(facts_by_name.at(ticks[0][i]), value.empty() ? 0.0f : std::stof(value));
    }
    mind.tick(facts, mts::milliseconds(200));
    const auto column = column_of.find(tick);
    if (column == column_of.end()) continue;
    for (std::size_t r = 0; r < rows.size(); ++r) ours[r][column->second] = reader.read(rows[r].at(1), rows[r].at(2));
  }
  return ours;
}

/// "1", ".8", and a dot for -1: "certainly not".
std::string show(float x) {
  if (x == -1.0f) return "\u00b7";
  if (x == 1.0f) return "1";
  if (x == 0.0f) return "0";
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", static_cast<double>(x));
  return text[0] == '0' ? text + 1 : text;
}

void print_cell(const std::string& text, bool differs, bool color) {
  const int width = text == "\u00b7" ? 1 : static_cast<int>(text.size());
  std::printf("%*s%s%s%s%s", 4 - width - (differs ? 1 : 0), "", differs ? "!" : "", differs && color ? "\x1b[1;31m" : "",
              text.c_str(), differs && color ? "\x1b[0m" : "");
}

/// The two cells in which we take the paper's table for misprinted, and why.
const std::map<std::string, const char*> kMisprints = {
    {"satfU_Moving_dist 14b", "printed 1, but no rule can have set it there: its sister columns 3 and 14d print -1"},
    {"UManeuver_left_mark 14d", "printed -1, although its satellite is 1 and nothing competes with it: compare columns 3 and 14b"}};

int compare(const std::vector<Fields>& table, const std::vector<Fields>& rows, const std::vector<std::vector<float>>& ours) {
  const bool color = isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
  const std::size_t columns = table[0].size() - 1;
  std::printf("Table 1 of Kargin and Ivaniuk (2020)%*s| this run\n%-28s", 60, "", "");
  for (int side = 0; side < 2; ++side) {
    for (std::size_t c = 1; c <= columns; ++c) std::printf("%4s", table[0][c].c_str());
    std::printf(side == 0 ? " |" : "\n");
  }
  std::size_t agree = 0, misprints = 0, computed = 0, fed = 0;   // facts are fed: they agree by themselves
  std::string remarks;
  for (std::size_t r = 1; r < table.size(); ++r) {
    std::printf("%-28s", table[r][0].c_str());
    std::vector<bool> differs(columns);
    const bool is_fact = rows[r - 1].at(1) == "fact";
    (is_fact ? fed : computed) += columns;
    for (std::size_t c = 0; c < columns; ++c) {
      const float printed = std::stof(table[r][c + 1]);
      differs[c] = std::fabs(printed - ours[r - 1][c]) > 1e-6f;
      print_cell(show(printed), differs[c], color);
      if (!differs[c]) {
        agree += is_fact ? 0 : 1;
        continue;
      }
      const std::string place = table[r][0] + " " + table[0][c + 1];
      const auto known = kMisprints.find(place);
      misprints += known != kMisprints.end() ? 1 : 0;
      remarks += "  " + place + ": " + (known != kMisprints.end() ? known->second : "NOT EXPLAINED") + "\n";
    }
    std::printf(" |");
    for (std::size_t c = 0; c < columns; ++c) print_cell(show(ours[r - 1][c]), differs[c], color);
    std::printf("\n");
  }
  std::printf("\n%zu of the %zu cells that the mind computes agree; %zu we take for misprints of the paper. %zu more are the facts that it is fed\n%s", agree, computed, misprints, fed, remarks.c_str());
  return agree + misprints == computed && misprints == kMisprints.size() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string folder = argc > 1 ? argv[1] : EXAMPLE_FOLDER;
  const auto table = read(folder + "/table1.csv", ',');
  const auto rows = read(folder + "/table1.rows.csv", ';');
  if (rows.size() + 1 != table.size()) throw std::runtime_error("table1.rows.csv and table1.csv have different rows");
  return compare(table, rows, run(folder, rows, table[0].size() - 1));
} catch (const std::exception& error) {
  std::fprintf(stderr, "example_route1: %s\n", error.what());
  return 1;
}
