// The header of a file of facts, and messages about places in its lines.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_map>

#include "compiler/diagnostics/display.h"
#include "compiler/source/utf8.h"
#include "tools/kbc/trace/cell_names.h"
#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/trace/facts_csv.h"

namespace kb::trace {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::CellKind;

// A column that what defines a fact depends on. `given` has those of the facts.
CellId defining_column(const program::Perception& perception, program::PerceptId id, const std::vector<CellId>& given) {
  const program::Percept& percept = perception[id];
  if (percept.op == PerceptOp::kFact) return given[program::index(percept.cell)];
  for (const program::PerceptId part : percept.children) {
    if (const CellId found = defining_column(perception, part, given); found != CellId::kNone) return found;
  }
  return CellId::kNone;
}

}  // namespace

struct FactsReader::Header {
  CellNames cells;
  std::unordered_map<std::string, std::uint32_t> readings{};   // by plain name; looked up, never iterated
  std::unordered_map<std::uint32_t, Mark> taken{};             // by column; likewise
};

bool FactsReader::read_header(const LineReader::Line& line) {
  if (reject_bytes(line, line.text) || reject_separator(line) || reject_numbers(line)) return false;
  Header header{CellNames(program_)};
  const program::Perception& perception = program_.perception;
  for (std::uint32_t r = 0; named_ == Columns::kReadings && r < perception.readings(); ++r) {
    header.readings.try_emplace(plain_name(perception.reading_name(r)), r);
  }
  bool good = true;
  std::size_t number = 0;
  for (FieldCursor fields(line.text, scratch_, true); fields.more();) {
    const Field field = fields.next();
    if (field.fault != Field::Fault::kNone) {
      reject_field(line, field);
      return false;
    }
    good = add_column(field, ++number, line, header) && good;
  }
  if (good && named_ == Columns::kFacts) warn_of_unperceived(line);
  return good;
}

// Facts that are defined by others are not computed from a recording of facts, which gives them itself. `kbc sim --facts` leaves out facts that are
// 0 throughout, as a lazy one may well be.
void FactsReader::warn_of_unperceived(const LineReader::Line& line) {
  const program::Perception& perception = program_.perception;
  std::vector<CellId> given(program_.facts, CellId::kNone);   // by fact: a column that it depends on; its own if it has one
  for (const std::uint32_t column : columns_) {
    if (column != kTimeColumn) given[column] = CellId{column};
  }
  std::vector<bool> asked(program_.facts, program_.conds.empty());   // by a rule; of two knowledge bases only the inputs are known here
  for (const program::Cond& cond : program_.conds) {
    if (program::index(cond.cell) < program_.facts) asked[program::index(cond.cell)] = true;
  }
  bool gives_perceived = false;
  CellId first = CellId::kNone;
  std::size_t count = 0;
  for (const program::Perceived& perceived : perception.perceived) {   // those that define a fact come before it
    CellId& fact = given[program::index(perceived.fact)];
    gives_perceived = gives_perceived || fact == perceived.fact;
    if (fact != CellId::kNone) continue;
    fact = defining_column(perception, perceived.percept, given);
    if (fact == CellId::kNone || perceived.lazy || !asked[program::index(perceived.fact)]) continue;
    if (count++ == 0) first = perceived.fact;
  }
  if (count == 0) return;
  const std::string more = count > 1 ? fmt::format(" (and {} more)", diagnostics::counted(count - 1, "fact")) : std::string();
  const auto end = static_cast<std::uint32_t>(line.text.size());
  auto message = report(Kind::kFactsUnperceived, line, {0, std::max(end, 1u)}, {program_[first].name, program_[given[program::index(first)]].name, more});
  if (!gives_perceived) message.note(Kind::kFactsByReadings, {});   // readings cannot give what is perceived
}

std::vector<bool> FactsReader::given() const {
  std::vector<bool> given(program_.facts, false);
  for (const std::uint32_t column : columns_) {
    if (column < program_.facts) given[column] = true;
  }
  return given;
}

bool FactsReader::add_column(const Field& field, std::size_t number, const LineReader::Line& line, Header& header) {
  const Mark mark{field.begin, std::max(field.end, field.begin + 1)};
  const std::string shown = source::printable(field.text);
  const auto reject = [&](Kind kind, std::initializer_list<std::string_view> arguments) {
    return report(kind, line, mark, arguments);
  };
  if (field.text.empty()) {
    reject(Kind::kFactsNoName, {fmt::format("{}", number)});
    return false;
  }
  std::uint32_t column = kTimeColumn;
  if (field.text != "t") {
    const auto found = find_column(field, header, line, mark);
    if (!found) return false;
    column = *found;
  }
  if (const auto [first, fresh] = header.taken.try_emplace(column, mark); !fresh) {
    reject(Kind::kFactsTwice, {shown}).note(Kind::kFactsFirstColumn, place(line, first->second));
    return false;
  }
  timed_ = timed_ || column == kTimeColumn;
  columns_.push_back(column);
  return true;
}

// The fact or the reading that a column names. Reports if there is none.
std::optional<std::uint32_t> FactsReader::find_column(const Field& field, const Header& header, const LineReader::Line& line, Mark mark) {
  const program::Perception& perception = program_.perception;
  const std::string shown = source::printable(field.text);
  if (const auto reading = header.readings.find(plain_name(field.text)); reading != header.readings.end()) return reading->second | kReadingBit;
  const CellId cell = header.cells.find(field.text);
  if (cell == CellId::kNone) {
    reject_name(field, shown, header, line, mark);
    return std::nullopt;
  }
  if (program_[cell].kind != CellKind::kFact) {
    report(Kind::kFactsNotAFact, line, mark, {shown, word(program_[cell].kind)});
    return std::nullopt;
  }
  for (const program::Perceived& perceived : perception.perceived) {
    if (named_ != Columns::kReadings || perceived.fact != cell) continue;
    report(Kind::kReadingsPerceived, line, mark, {shown, percept_text(program_, perceived.percept)});
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(program::index(cell));
}

std::optional<std::string> FactsReader::nearest_name(std::string_view name, const Header& header) const {
  if (const program::Sensor* sensor = find_sensor(name); sensor != nullptr && sensor->array) return fmt::format("{}[0]", name);
  std::vector<std::string> readings;
  for (std::uint32_t r = 0; r < header.readings.size(); ++r) readings.push_back(program_.perception.reading_name(r));
  const std::vector<std::string_view> candidates(readings.begin(), readings.end());
  auto found = diagnostics::closest(name, candidates);
  return found ? found : header.cells.closest(name, CellKind::kFact);
}

// Reports a name that is neither a cell nor a reading.
void FactsReader::reject_name(const Field& field, std::string_view shown, const Header& header, const LineReader::Line& line, Mark mark) {
  const program::Sensor* sensor = named_ == Columns::kFacts ? find_sensor(field.text) : nullptr;
  if (sensor != nullptr) return reject_sensor(*sensor, shown, line, mark);
  auto suggestion = diagnostics_.full() ? std::nullopt : nearest_name(field.text, header);
  constexpr std::array<std::string_view, 8> kTimes{"T", "time", "Time", "TIME", "timestamp", "time_s", "time [s]", "seconds"};
  if (std::find(kTimes.begin(), kTimes.end(), field.text) != kTimes.end()) suggestion = "t";
  report(header.readings.empty() ? Kind::kFactsUnknownName : Kind::kReadingsUnknownName, line, mark, {shown}).suggest(suggestion);
}

// Finds the sensor of `beam` and `beam[0]`, also of `beam[9]` if `beam` has fewer elements.
const program::Sensor* FactsReader::find_sensor(std::string_view name) const {
  const std::string plain = plain_name(name);
  for (const program::Sensor& sensor : program_.perception.sensors) {
    if (plain == sensor.name || plain.starts_with(sensor.name + '.')) return &sensor;
  }
  return nullptr;
}

// A recording of readings instead of facts gets one message, however many columns it has.
void FactsReader::reject_sensor(const program::Sensor& sensor, std::string_view shown, const LineReader::Line& line, Mark mark) {
  if (sensor_told_) return;
  sensor_told_ = true;
  report(Kind::kFactsUnknownName, line, mark, {shown}).note(Kind::kFactsOfSensor, {}, {sensor.name});
}

// Many spreadsheets separate by semicolons. Without a message of its own, the header would be reported as one long unknown name.
bool FactsReader::reject_separator(const LineReader::Line& line) {
  if (line.text.find(',') != std::string_view::npos) return false;
  const std::size_t at = line.text.find_first_of(";\t", line.text.find_first_not_of(" \t"));
  if (at == std::string_view::npos) return false;
  const auto place = static_cast<std::uint32_t>(at);
  report(Kind::kFactsSeparator, line, {place, place + 1}, {line.text[at] == ';' ? "`;`" : "a tab"});
  return true;
}

// A file without a header begins with numbers. That gets one message; no fact is called `0.9`.
bool FactsReader::reject_numbers(const LineReader::Line& line) {
  const std::string_view first = line.text.substr(0, line.text.find(','));
  const std::size_t begin = first.find_first_not_of(" \t"), end = first.find_last_not_of(" \t");
  if (begin == std::string_view::npos) return false;
  double number = 0.0;
  const auto [stop, fault] = std::from_chars(first.data() + begin, first.data() + end + 1, number);
  if (fault == std::errc::invalid_argument || stop != first.data() + end + 1) return false;
  const Mark mark{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end + 1)};
  report(Kind::kFactsNoHeader, line, mark, {path_});
  return true;
}

bool FactsReader::reject_bytes(const LineReader::Line& line, std::string_view text, std::size_t begin) {
  const std::size_t fault = source::find_ill_formed(text);
  if (fault == std::string_view::npos) return false;
  const auto place = static_cast<std::uint32_t>(begin + fault);
  report(Kind::kFactsNotUtf8, line, {place, place + 1}, {});
  return failed_ = true;
}

void FactsReader::reject_field(const LineReader::Line& line, const Field& field) {
  const Mark mark{field.begin, field.end};
  if (field.fault == Field::Fault::kOpenQuote) {
    report(Kind::kFactsOpenQuote, line, {mark.begin, mark.begin + 1}, {});
  } else {
    report(Kind::kFactsAfterQuote, line, mark, {source::printable(field.text)});
  }
}

// Reports a wrong number of fields: those that were read, plus those in `rest`.
void FactsReader::reject_count(const LineReader::Line& line, std::size_t fields, FieldCursor& rest) {
  Mark mark{static_cast<std::uint32_t>(line.text.size()), static_cast<std::uint32_t>(line.text.size() + 1)};
  for (bool first = true; rest.more(); ++fields, first = false) {
    const Field surplus = rest.next();
    if (first) mark = {surplus.begin, std::max(surplus.end, surplus.begin + 1)};
  }
  auto said = report(Kind::kFactsFieldCount, line, mark, {diagnostics::counted(fields, "field"), diagnostics::counted(columns_.size(), "column")});
  if (!line.ended) said.note(Kind::kFactsTidy, {}, {path_});   // half written when the power went
}

diagnostics::Builder FactsReader::report(Kind kind, const LineReader::Line& line, Mark mark,
                                         std::initializer_list<std::string_view> arguments) {
  return diagnostics_.report(kind, place(line, mark), arguments);
}

// An excerpt contains the line up to the place, so the excerpts for a header of 100,000 wrong names would fill the memory.
source::Span FactsReader::place(const LineReader::Line& line, Mark mark) {
  return diagnostics_.full() ? source::Span{} : excerpt(sources_, path_, line, mark.begin, mark.end);
}

}  // namespace kb::trace
