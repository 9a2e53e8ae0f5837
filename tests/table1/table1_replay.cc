#include "tests/table1/table1_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "compiler/source/encoding.h"

namespace kb::table1 {
namespace {

using Facts = std::vector<std::pair<std::string, double>>;

double number(std::string_view text) {
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size())
    throw std::runtime_error("no number: " + std::string(text));
  return value;
}

/// Gone between two columns; see note [quiet ticks between the columns].
bool momentary(std::string_view fact) {
  constexpr std::array<std::string_view, 5> kMomentary{"Line", "Start1", "Obst", "CrossBy.", "MoveBy."};
  return std::any_of(kMomentary.begin(), kMomentary.end(), [&](std::string_view word) {
    return fact == word || (word.back() == '.' && fact.starts_with(word));
  });
}

/// Writes the sequence of ticks down.
class FeedWriter {
 public:
  void tick(const Facts& facts, std::string_view column = {}) {
    feed_.push_back({{{"Track.mark", 1.0}, {"Track.dist", 1.0}, {"Track.azimuth", 1.0}}, std::string(column)});
    feed_.back().facts.insert(feed_.back().facts.end(), facts.begin(), facts.end());
  }
  void quiet(Facts facts) {
    std::erase_if(facts, [](const auto& fact) { return momentary(fact.first); });
    for (int i = 0; i < kQuietTicks; ++i) tick(facts);
  }
  void event(const Facts& facts, std::string_view column = {}) {
    tick(facts, column);
    quiet(facts);
  }
  /// The sign, the line in, the line out of a landmark that is driven by the marking. The sign's own tick, with the
  /// road of arrival, is left out where the table has printed it (`arrival` empty).
  void passage(const std::string& landmark, const std::string& arrival) {
    const Facts sign{{landmark, 1.0}, {"Safe", 1.0}};
    const auto with = [&](const Facts& more) {
      Facts all = sign;
      all.insert(all.end(), more.begin(), more.end());
      return all;
    };
    if (!arrival.empty()) {
      tick(with({{"In." + arrival, 1.0}}));
      quiet(sign);
    }
    event(with({{"Line", 1.0}, {"CrossBy.mark", 1.0}}));
    tick(with({{"Line", 1.0}, {"MoveBy.mark", 1.0}}));
    quiet({});
  }
  [[nodiscard]] std::vector<Feed> take() { return std::move(feed_); }

 private:
  std::vector<Feed> feed_;
};

Facts facts_of(const Table& table, std::size_t column) {
  Facts facts;
  for (const Table::Row& row : table.rows) {
    const Meaning meaning = meaning_of(row.name);
    if (meaning.kind == Meaning::Kind::kFact) facts.emplace_back(meaning.cell, row.values[column]);
  }
  return facts;
}

double read_cell(const world::Knowledge& knowledge, const world::Mind& mind, const Meaning& meaning) {
  const program::CellId cell = knowledge.cell(meaning.cell);
  if (meaning.kind != Meaning::Kind::kSatelliteOf) return static_cast<double>(mind.value(cell));
  double highest = -1.0;
  for (const program::CellId satellite : knowledge.program()[cell].satellites) {
    highest = std::max(highest, static_cast<double>(mind.value(satellite)));
  }
  return highest;
}

bool agree(const Cell& cell) { return std::abs(cell.paper - cell.ours) <= 1e-6; }

}  // namespace

Table read_table(std::string_view csv) {
  Table table;
  for (std::string_view line : source::split(csv, '\n')) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const auto fields = source::split(line, ',');
    if (table.columns.empty()) {
      table.columns.assign(fields.begin() + 1, fields.end());
      continue;
    }
    if (fields.size() != table.columns.size() + 1) throw std::runtime_error("fields are missing: " + std::string(line));
    Table::Row row{std::string(fields[0]), {}};
    for (std::size_t i = 1; i < fields.size(); ++i) row.values.push_back(number(fields[i]));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Meaning meaning_of(std::string_view row) {
  using Kind = Meaning::Kind;
  static const std::pair<std::string_view, Meaning> kNamed[] = {
      {"fObsti", {Kind::kFact, "Obst"}},
      {"satfObsti", {Kind::kSatelliteOf, "Obst"}},
      {"satfU_Obsti", {Kind::kSatelliteOf, "Avoid"}},
      {"UObsti", {Kind::kStrategy, "Avoid"}},
      {"satfObsti_mark", {Kind::kCell, "Obst_mark"}},
      {"fManeuver_mark", {Kind::kFact, "CrossBy.mark"}},
      {"satfManeuver_mark", {Kind::kSatelliteOf, "CrossBy.mark"}},
      {"satfLine_in", {Kind::kCell, "Line_in"}},
      {"satfLine_out", {Kind::kCell, "Line_out"}},
      {"satfRoute1", {Kind::kCell, "Route1"}},
  };
  for (const auto& [name, meaning] : kNamed) {
    if (name == row) return meaning;
  }
  const auto crossing = [](std::string_view turn_and_method) {
    const auto parts = source::split(turn_and_method, '_');
    return fmt::format("Cross[{},{}]", parts.at(0), parts.at(1));
  };
  // The longest prefix that fits counts, so they stand in this order.
  static constexpr struct { std::string_view prefix; Kind kind; std::string_view cell; } kPrefixes[] = {
      {"satfU_Maneuver_", Kind::kSatelliteOf, ""}, {"UManeuver_", Kind::kStrategy, ""},
      {"satfU_Moving_", Kind::kSatelliteOf, "Move."}, {"UMoving_", Kind::kStrategy, "Move."},
      {"fMoving_", Kind::kFact, "MoveBy."}, {"satfManeuver_", Kind::kCell, "Turn."},
      {"satfOut_", Kind::kCell, "Out."}, {"fIn_", Kind::kFact, "In."},
      {"satf", Kind::kSatelliteOf, " "}, {"f", Kind::kFact, " "},
  };
  for (const auto& [prefix, kind, cell] : kPrefixes) {
    if (!row.starts_with(prefix)) continue;
    const std::string_view rest = row.substr(prefix.size());
    if (cell.empty()) return {kind, crossing(rest)};
    return {kind, cell == " " ? std::string(rest) : fmt::format("{}{}", cell, rest)};
  }
  throw std::runtime_error("the table has a row that means nothing: " + std::string(row));
}

std::vector<Feed> feed_of(const Table& table) {
  FeedWriter writer;
  writer.quiet({});
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i] == "14") {
      writer.passage("LM2", "");
      writer.passage("LM3", "N");
      writer.passage("LM6", "W");
    }
    writer.event(facts_of(table, i), table.columns[i]);
  }
  return writer.take();
}

std::vector<Cell> Result::differences() const {
  std::vector<Cell> found;
  for (const Cell& cell : cells) {
    if (!agree(cell)) found.push_back(cell);
  }
  return found;
}

Result replay(std::string_view table_csv, const world::Knowledge& knowledge, world::Mind& mind) {
  const Table table = read_table(table_csv);
  std::vector<Meaning> meanings;
  for (const Table::Row& row : table.rows) meanings.push_back(meaning_of(row.name));
  const std::size_t width = table.columns.size();
  Result result;
  result.cells.resize(table.rows.size() * width);
  for (const Feed& feed : feed_of(table)) {
    std::vector<float> facts(knowledge.program().facts);
    for (const auto& [name, value] : feed.facts)
      facts[program::index(knowledge.cell(name))] = static_cast<float>(value);
    result.conflicts += static_cast<int>(mind.tick(facts, kTickUs).conflicts.size());
    if (feed.column.empty()) continue;
    const auto column = static_cast<std::size_t>(
        std::find(table.columns.begin(), table.columns.end(), feed.column) - table.columns.begin());
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      result.cells[row * width + column] = {table.rows[row].name, feed.column, table.rows[row].values[column],
                                            read_cell(knowledge, mind, meanings[row])};
    }
  }
  return result;
}

std::string facts_csv(const std::vector<Feed>& feed) {
  std::vector<std::string> columns;
  for (const Feed& tick : feed) {
    for (const auto& [name, value] : tick.facts) {
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
    }
  }
  std::string csv = "t";
  for (const std::string& column : columns) csv += "," + column;
  for (std::size_t i = 0; i < feed.size(); ++i) {
    csv += fmt::format("\n{:.1f}", static_cast<double>(i) * kTickUs / 1e6);
    for (const std::string& column : columns) {
      csv += ',';
      for (const auto& [name, value] : feed[i].facts) {
        if (name == column) csv += fmt::format("{}", value);
      }
    }
  }
  return csv + "\n";
}

std::string columns_csv(const std::vector<Feed>& feed) {
  std::string csv = "tick,column\n";
  for (std::size_t i = 0; i < feed.size(); ++i) {
    if (!feed[i].column.empty()) csv += fmt::format("{},{}\n", i + 1, feed[i].column);
  }
  return csv;
}

}  // namespace kb::table1
