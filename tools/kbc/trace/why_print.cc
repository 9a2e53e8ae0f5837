// Answers as text and as JSON.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compiler/program/conditions.h"
#include "tools/kbc/trace/json_number.h"
#include "tools/kbc/trace/why.h"

namespace kb::trace {
namespace {

using nlohmann::ordered_json;
using program::CellId;
using program::Program;
using program::Record;
using program::RuleId;

const char* outcome_word(program::Outcome outcome) {
  switch (outcome) {
    case program::Outcome::kFired: return "fired";
    case program::Outcome::kFiredContradicted: return "contradicted";
    case program::Outcome::kFalse: return "false";
    case program::Outcome::kNotArmed: return "not_armed";
    case program::Outcome::kSilenced: return "silenced";
  }
  return "";
}

ordered_json json_rule(const Program& program, const Record& record, const RuleAnswer& answer) {
  const program::Rule& rule = program[answer.story.rule];
  ordered_json out{{"rule", rule.name},
                   {"at", program.at(rule)},
                   {"level", program.levels[rule.level]},
                   {"outcome", outcome_word(answer.story.outcome)}};
  if (const auto before = record.fired_before[index(answer.story.rule)]; before > 0) out["fired_before"] = before;
  out["lacking"] = answer.near.lacking;
  out["reasons"] = ordered_json::array();
  for (const program::Reason& reason : answer.story.reasons)
    out["reasons"].push_back({{"condition", reason.condition}, {"holds", reason.holds}, {"text", reason.text}});
  out["reads"] = ordered_json::object();
  for (const program::CondId id : program::reachable(program.conds, {rule.condition})) {
    if (const CellId cell = program[id].cell; cell != CellId::kNone)
      out["reads"][program[cell].name] = json_number(record.levels[rule.level].cf[index(cell)]);
  }
  out["text"] = answer.story.text;
  return out;
}

ordered_json json_rules(const Program& program, const Record& record, const std::vector<RuleAnswer>& answers) {
  ordered_json out = ordered_json::array();
  for (const RuleAnswer& answer : answers) out.push_back(json_rule(program, record, answer));
  return out;
}

ordered_json json_cell(const Program& program, const Record& record, const CellAnswer& answer) {
  const program::LastWrite& last = record.last_write[index(answer.story.cell)];
  ordered_json out{{"cell", program[answer.story.cell].name}, {"value", json_number(answer.story.value)}};
  if (last.tick > 0) {
    out["last_write"] = {{"tick", last.tick}, {"rules", ordered_json::array()}};
    for (const RuleId rule : last.rules) out["last_write"]["rules"].push_back(program[rule].name);
  }
  if (!answer.threshold.empty()) out["threshold"] = answer.threshold;
  for (const std::uint32_t level : answer.passing)
    out["passing"].push_back({{"level", program.levels[level]}, {"value", json_number(record.levels[level].cf[index(answer.story.cell)])}});
  if (!answer.writers.empty()) out["writers"] = json_rules(program, record, answer.writers);
  out["raisers"] = json_rules(program, record, answer.raisers);
  out["text"] = answer.story.text;
  return out;
}

ordered_json json_strategy(const Program& program, const Record& record, const StrategyAnswer& answer) {
  ordered_json out{{"strategy", program[answer.story.strategy].name},
                   {"ran", answer.story.dispatched},
                   {"before", ordered_json::array()}};
  for (const CellId before : answer.before) out["before"].push_back(program[before].name);
  out["rule"] = json_rule(program, record, {answer.story.rule, nearness(program, record, answer.story.rule.rule)});
  out["text"] = answer.story.text;
  return out;
}

// Prints the sentence, the place of the rule and, if it fired, what its condition found.
void print_rule(const Program& program, const RuleAnswer& answer, std::string_view indent, std::string& out) {
  const program::Rule& rule = program[answer.story.rule];
  out += fmt::format("{}{}\n{}    ({}, level {})\n", indent, answer.story.text, indent, program.at(rule),
                     program.levels[rule.level]);
  if (!answer.fired()) return;
  for (const program::Reason& reason : answer.story.reasons)
    if (!reason.text.empty()) out += fmt::format("{}    {}\n", indent, reason.text);
}

void print_rules(const Program& program, const std::vector<RuleAnswer>& answers, std::size_t most,
                 std::string_view indent, std::string& out) {
  for (std::size_t i = 0; i < answers.size() && i < most; ++i) print_rule(program, answers[i], indent, out);
  if (answers.size() > most) out += fmt::format("{}... and {} more\n", indent, answers.size() - most);
}

void print_cell(const Program& program, const Record& record, const CellAnswer& cell, std::size_t most, std::string& out) {
  out += cell.story.text + "\n";
  if (!cell.threshold.empty()) out += "  " + cell.threshold + "\n";
  for (const std::uint32_t level : cell.passing) {
    out += fmt::format("  within this tick: the rules of level `{}` found it at {:.2f}\n", program.levels[level], record.levels[level].cf[index(cell.story.cell)]);
  }
  print_rules(program, cell.writers, most, "    ", out);
  if (const std::uint64_t written = record.last_write[index(cell.story.cell)].tick; !cell.story.rules.empty() && cell.writers.empty())
    out += fmt::format("  `--tick {}` tells why\n", written);
  if (cell.lacks_raiser) out += cell.story.value > -1.0f ? "  no rule raises it any higher\n" : "  no rule raises it\n";
  if (cell.raisers.empty()) return;
  const bool passing = !cell.passing.empty();
  if (cell.raisers.size() == 1) out += passing ? "  one rule raises it:\n" : "  one rule would raise it:\n";
  else out += fmt::format("  {} rules {} it, the nearest first:\n", cell.raisers.size(), passing ? "raise" : "would raise");
  print_rules(program, cell.raisers, most, "    ", out);
}

}  // namespace

std::string print(const Program& program, const Record& record, const Answer& answer, std::size_t most) {
  std::string out;
  print_rules(program, answer.rules, answer.of_whole_tick ? SIZE_MAX : most, "", out);
  if (answer.of_whole_tick && answer.rules.empty())
    out += fmt::format("no rule fired at tick {}\n", record.tick.number);
  if (answer.strategy) {
    out += answer.strategy->story.text + "\n";
    for (const CellId before : answer.strategy->before)
      out += fmt::format("  `{}` goes before it, and was wanted\n", program[before].name);
  } else if (answer.of_whole_tick) {
    out += fmt::format("nothing ran at tick {}{}\n", record.tick.number, record.tick.status == program::Status::kHoldExpired ? ": `hold_limit` is over" : "");
  }
  for (const CellAnswer& cell : answer.cells) print_cell(program, record, cell, most, out);
  if (answer.sighting) out += print(*answer.sighting);
  return out;
}

std::string print_json(const Program& program, const Record& record, const Answer& answer) {
  ordered_json out{{"tick", record.tick.number},
                   {"t", static_cast<double>(record.tick.time_us) / 1e6},
                   {"status", status_text(record.tick.status)}};
  if (answer.ticks) out["ticks"] = *answer.ticks;
  for (const float value : answer.values) out["values"].push_back(json_number(value));
  if (!answer.within.empty()) out["within"] = answer.within;
  out["rules"] = json_rules(program, record, answer.rules);
  if (answer.strategy) out["strategy"] = json_strategy(program, record, *answer.strategy);
  out["cells"] = ordered_json::array();
  for (const CellAnswer& cell : answer.cells) out["cells"].push_back(json_cell(program, record, cell));
  if (answer.sighting) out["cells"].back()["sighting"] = json_sighting(*answer.sighting);
  return out.dump();
}

}  // namespace kb::trace
