#include "compiler/program/text.h"
#include "compiler/program/tick.h"

namespace kb::program {
namespace {

/// `,"key":["name",...]`, the names of cells or rules.
template <class Id>
void append_names(std::string& out, const Program& program, std::string_view key, const std::vector<Id>& ids) {
  append_key(out, key);
  append_items(out, ids, [&](Id id) { append_json(out, program[id].name); });
}

void append_values(std::string& out, const Program& program, std::string_view key, const std::vector<CellValue>& set) {
  append_key(out, key);
  out += '{';
  Commas commas;
  for (const CellValue& cell : set) {
    commas.next(out);
    append_json(out, program[cell.cell].name);
    out += ':';
    append_number(out, cell.value + 0.0f);   // no negative zero
  }
  out += '}';
}

void append_conflicts(std::string& out, const Program& program, const std::vector<Conflict>& conflicts) {
  append_key(out, "conflicts");
  append_items(out, conflicts, [&](const Conflict& conflict) {
    out += "{\"cell\":";
    append_json(out, program[conflict.cell].name);
    append_names(out, program, "rules", conflict.rules);
    out += '}';
  });
}

}  // namespace

std::string print_json(const Program& program, const Tick& tick) {
  std::string out = "{\"tick\":" + std::to_string(tick.number) + ",\"t\":";
  append_seconds(out, tick.time_us);
  append_names(out, program, "events", tick.events);
  append_names(out, program, "lost", tick.lost);
  append_names(out, program, "fired", tick.fired);
  append_values(out, program, "set", tick.set);
  append_conflicts(out, program, tick.conflicts);
  out += ",\"strategy\":";
  if (tick.strategy == CellId::kNone) {
    out += "null";
  } else {
    append_json(out, program[tick.strategy].name);
  }
  out += ",\"status\":\"";
  out += status_text(tick.status);
  out += '"';
  if (!tick.perceived.empty()) append_values(out, program, "cf", tick.perceived);
  out += '}';
  return out;
}

}  // namespace kb::program
