// Tables: total functions over finite sets, whose entries may be given in several places (`table f more { ... }`).
#include <fmt/format.h>

#include <algorithm>

#include "compiler/diagnostics/display.h"
#include "compiler/model/draft.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

constexpr std::size_t kMissingShown = 5;

class TableReader {
 public:
  TableReader(Draft& draft, Table& table, const syntax::Table& from) : draft_(draft), table_(table), from_(from) {}

  void run() {
    const bool two = table_.parameters.size() == 2;
    std::vector<std::optional<std::uint32_t>> columns;
    if (two) {
      for (const syntax::Name& column : from_.columns) columns.push_back(is_first_column(column) ? member(column, table_.parameters[1]) : std::nullopt);
    } else {
      columns.push_back(0);
    }
    if (two && columns_are_wrong()) return;
    for (const syntax::Table::Line& line : from_.lines) {
      const auto label = member(line.label, table_.parameters[0]);
      if (line.values.size() != columns.size()) {
        draft_.diagnostics.report(Kind::kTableLine, line.label.span,
                                  {table_.name, diagnostics::counted(line.values.size(), "value"),
                                   two ? "the line of columns has " + std::to_string(columns.size())
                                       : std::string("a table with one parameter has 1")});
        complete_ = false;
        continue;
      }
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto value = member(line.values[i], table_.result);
        if (label && columns[i]) enter(*label, *columns[i], value, line.values[i].span);
      }
    }
  }
  /// False if something has been reported that may be the reason for missing entries.
  [[nodiscard]] bool complete() const { return complete_; }

 private:
  /// True, with one message, if all lines have the same number of values but there is another number of columns.
  [[nodiscard]] bool columns_are_wrong() {
    const std::size_t values = from_.lines.empty() ? 0 : from_.lines.front().values.size();
    const bool alike = std::ranges::all_of(from_.lines, [&](const syntax::Table::Line& line) { return line.values.size() == values; });
    if (from_.lines.size() < 2 || !alike || values == from_.columns.size()) return false;
    draft_.diagnostics.report(Kind::kTableLine, from_.columns.front().span,
                              {table_.name, diagnostics::counted(from_.columns.size(), "column"), "all others have " + diagnostics::counted(values, "value")});
    complete_ = false;
    return true;
  }

  /// Whether it is the first column of this name. A column that is there twice is reported once, not for each line.
  [[nodiscard]] bool is_first_column(const syntax::Name& column) {
    const auto first = std::ranges::find(from_.columns, column.text, &syntax::Name::text);
    if (first->span == column.span) return true;
    draft_.diagnostics.report(Kind::kTableEntryTwice, column.span, {table_.name, fmt::format("column `{}`", column.text)})
        .note(Kind::kFirstDeclaredHere, first->span);
    complete_ = false;
    return false;
  }

  std::optional<std::uint32_t> member(syntax::Name name, SetId set) {
    if (const auto found = draft_.member(set, name.text)) return found->index;
    complete_ = false;
    const FiniteSet& known = draft_.model.sets[index(set)];
    report_unknown_member(draft_, Kind::kUnknownMember, name, {known.name, {}, known});
    return std::nullopt;
  }

  void enter(std::uint32_t label, std::uint32_t column, std::optional<std::uint32_t> value, source::Span at) {
    const std::size_t width = table_.parameters.size() == 2 ? draft_.model.sets[index(table_.parameters[1])].members.size() : 1;
    const std::size_t place = label * width + column;
    if (table_.places[place].known()) {
      std::string entry = draft_.model.sets[index(table_.parameters[0])].members[label];
      if (width > 1) entry = fmt::format("({}, {})", entry, draft_.model.sets[index(table_.parameters[1])].members[column]);
      draft_.diagnostics.report(Kind::kTableEntryTwice, at, {table_.name, fmt::format("`{}`", entry)})
          .note(Kind::kFirstDeclaredHere, table_.places[place]);
      return;
    }
    table_.places[place] = at;
    table_.values[place] = value.value_or(0);
  }

  Draft& draft_;
  Table& table_;
  const syntax::Table& from_;
  bool complete_ = true;
};

/// The place where a member was added to its set, if the missing entry belongs to such a member: that line is more likely wrong than
/// the table, which may be the library's.
std::optional<source::Span> added_member(const Draft& draft, const Table& table, std::size_t row, std::size_t column) {
  for (std::size_t i = 0; i < table.parameters.size(); ++i) {
    const std::size_t set = index(table.parameters[i]), place = i == 0 ? row : column;
    const std::optional<std::uint32_t> more = draft.sets[set].more;
    if (more && place >= *more) return draft.model.sets[set].places[place];
  }
  return std::nullopt;
}

void check_complete(Draft& draft, const Table& table) {
  std::string missing;
  std::optional<source::Span> added;
  std::size_t count = 0;
  const auto& rows = draft.model.sets[index(table.parameters[0])].members;
  const std::size_t width = table.parameters.size() == 2 ? draft.model.sets[index(table.parameters[1])].members.size() : 1;
  for (std::size_t i = 0; i < table.places.size(); ++i) {
    if (table.places[i].known()) continue;
    if (!added) added = added_member(draft, table, i / width, i % width);
    if (++count > kMissingShown) continue;
    missing += missing.empty() ? "`" : ", `";
    if (table.parameters.size() == 2) {
      missing += fmt::format("({}, {})", rows[i / width], draft.model.sets[index(table.parameters[1])].members[i % width]);
    } else {
      missing += rows[i];
    }
    missing += '`';
  }
  if (count == 0) return;
  if (count > kMissingShown) missing += fmt::format(" and {} more", count - kMissingShown);
  if (added) {
    draft.diagnostics.report(Kind::kTableIncomplete, *added, {table.name, missing})
        .note(Kind::kTableStandsHere, table.declared, {table.name});
  } else {
    draft.diagnostics.report(Kind::kTableIncomplete, table.declared, {table.name, missing});
  }
}

std::optional<Table> declare_table(Draft& draft, const syntax::Table& from) {
  Table table;
  table.name = from.name.text;
  table.declared = from.name.span;
  bool known = true;
  for (const syntax::Name& parameter : from.parameters) {
    const auto set = need_set(draft, parameter);
    known = known && set.has_value();
    if (set) table.parameters.push_back(*set);
  }
  const auto result = need_set(draft, from.result);
  if (!known || !result) return std::nullopt;
  const std::size_t count = table.parameters.size();
  if (count == 0 || count > 2 || (count == 2) == from.columns.empty()) {
    const std::string_view columns = from.columns.empty() ? "no columns" : "columns";
    draft.diagnostics.report(Kind::kTableParameters, from.name.span,
                             {table.name, diagnostics::counted(count, "parameter") + " and " + std::string(columns)});
    return std::nullopt;
  }
  table.result = *result;
  std::size_t entries = 1;
  for (const SetId set : table.parameters) entries *= draft.model.sets[index(set)].members.size();
  if (too_many_cells(draft, entries, table.name, table.declared)) return std::nullopt;
  table.values.assign(entries, kNone32);
  table.places.assign(entries, {});
  return table;
}

}  // namespace

void declare_tables(Draft& draft) {
  std::vector<bool> complete;
  bool lost_entries = false;  // entries for a table that was not found may have been meant for any table
  draft.each<syntax::Table>([&](const auto&, const auto&, const syntax::Table& from) {
    if (from.more) return;
    std::optional<Table> table = declare_table(draft, from);
    if (!draft.declare(from.name, Entity::Kind::kTable, draft.model.tables.size(), table.has_value())) return;
    draft.model.tables.push_back(std::move(*table));
    TableReader reader(draft, draft.model.tables.back(), from);
    reader.run();
    complete.push_back(reader.complete());
  });
  draft.each<syntax::Table>([&](const auto&, const auto&, const syntax::Table& from) {
    if (!from.more) return;
    const Entity* entity = draft.names.find(from.name.text);
    if (entity != nullptr && entity->kind == Entity::Kind::kBroken) return;
    if (entity == nullptr || entity->kind != Entity::Kind::kTable) {
      report_unknown(draft, Kind::kTableMoreOfUnknown, from.name, draft.names.nearest(from.name.text, Entity::Kind::kTable, draft.diagnostics));
      lost_entries = true;
      return;
    }
    TableReader reader(draft, draft.model.tables[entity->id], from);
    reader.run();
    complete[entity->id] = complete[entity->id] && reader.complete();
  });
  for (std::size_t i = 0; i < draft.model.tables.size(); ++i) {
    if (complete[i] && !lost_entries) check_complete(draft, draft.model.tables[i]);
  }
}

}  // namespace kb::model
