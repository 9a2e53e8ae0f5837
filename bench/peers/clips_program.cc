#include "bench/peers/clips_program.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace peers {
namespace {

using nlohmann::json;

class Writer {
 public:
  explicit Writer(const json& program) : in_(program) {}

  ClipsProgram write() {
    out_.firing = in_.at("settings").at("firing");
    out_.levels = static_cast<std::uint32_t>(in_.at("levels").size());
    cells();
    for (std::uint32_t l = 0; l < out_.levels; ++l) level_of_[in_["levels"][l]] = l;
    for (const json& rule : in_.at("rules")) this->rule(rule);
    std::vector<std::string> head{"(defmodule MAIN (export ?ALL))", "(deftemplate MAIN::tick)"};
    for (const Asked& asked : out_.asked) head.push_back("(deftemplate MAIN::" + asked.template_name + ")");
    for (std::uint32_t l = 0; l < out_.levels; ++l) {
      for (const char* of : {"L", "T"}) head.push_back("(defmodule " + (of + std::to_string(l)) + " (import MAIN ?ALL))");
    }
    head.insert(head.end(), rules_.begin(), rules_.end());
    out_.constructs = std::move(head);
    return std::move(out_);
  }

 private:
  void cells() {
    for (const json& cell : in_.at("cells")) {
      const std::string kind = cell.at("kind");
      const double event = cell.value("event", 0.0), attention = cell.value("attention", 0.0);
      cell_of_[cell.at("name")] = static_cast<std::uint32_t>(out_.cells.size());
      out_.cells.push_back({cell["name"], kind == "fact", kind == "strategy", cell.at("initial"), static_cast<float>(event),
                            static_cast<float>(event - attention), {}});
    }
    for (const json& cell : in_["cells"]) {
      if (cell["kind"] != "fact") continue;
      for (const json& satellite : cell["satellites"]) out_.cells[cell_of_.at(satellite)].draws.push_back(cell_of_.at(cell["name"]));
    }
  }

  /// The pattern `(high-Gate)`; makes its template known.
  std::string ask(Asked::Kind kind, std::uint32_t of, const std::string& name) {
    std::string word = name;
    for (char& c : word) {
      if (c == ' ') c = '_';   // `sat Line`
    }
    const auto [it, made] = asked_.emplace(word, out_.asked.size());
    if (made) out_.asked.push_back({kind, of, word});
    return "(" + word + ")";
  }

  std::string pattern(const json& condition) {
    const auto& [key, value] = *condition.items().begin();
    if (key == "is") {
      const std::string term = value[1], cell = value[0];
      const Asked::Kind kind = term == "high" ? Asked::Kind::kHigh : term == "low" ? Asked::Kind::kLow : Asked::Kind::kZero;
      return ask(kind, cell_of_.at(cell), term + "-" + cell);
    }
    if (key == "seen" || key == "event" || key == "lost") {
      const std::string cell = value;
      const Asked::Kind kind = key == "seen" ? Asked::Kind::kSeen : key == "event" ? Asked::Kind::kEvent : Asked::Kind::kLost;
      return ask(kind, cell_of_.at(cell), key + "-" + cell);
    }
    if (key == "not") return negated(value);
    if (key == "and") return list(value, false);
    if (key == "or") return "(not (and" + list(value, true) + "))";
    if (key == "for") return timer(value[0], value[1]);
    throw std::runtime_error("the program has a condition `" + key + "`, which is not known here");
  }
  std::string list(const json& conditions, bool negate) {
    std::string text;
    for (const json& condition : conditions) text += " " + (negate ? negated(condition) : pattern(condition));
    return text;
  }
  std::string negated(const json& condition) {
    const auto& [key, value] = *condition.items().begin();
    if (key == "not") return pattern(value);
    if (key == "or") return list(value, true);
    if (key == "and") return "(not (and" + list(value, false) + "))";
    return "(not " + pattern(condition) + ")";
  }

  /// A timer has two rules in the module of its level: its condition holds, or does not.
  std::string timer(const json& condition, double seconds) {
    if (in_timer_) throw std::runtime_error("a timer within a timer is not known here");
    in_timer_ = true;
    const std::string on = pattern(condition), off = negated(condition), key = on + std::to_string(seconds) + "@" + std::to_string(level_);
    in_timer_ = false;
    const auto [it, made] = timer_of_.emplace(key, static_cast<std::uint32_t>(out_.timers.size()));
    const std::string n = std::to_string(it->second), module = "T" + std::to_string(level_);
    if (made) {
      out_.timers.push_back({level_, static_cast<std::int64_t>(seconds * 1e6 + 0.5)});
      rules_.push_back("(defrule " + module + "::on-" + n + " " + on + " => (timer " + n + " 1))");
      rules_.push_back("(defrule " + module + "::off-" + n + " " + off + " => (timer " + n + " 0))");
    }
    return ask(Asked::Kind::kHeld, it->second, "held-" + n);
  }

  void rule(const json& rule) {
    level_ = level_of_.at(rule.at("level"));
    ClipsProgram::Rule made{rule.at("name"), rule.value("reset", false), {}};
    for (const json& write : rule.at("then")) made.writes.push_back({cell_of_.at(write[0]), write[1]});
    const std::string text = pattern(rule.at("if")), n = std::to_string(out_.rules.size());
    rules_.push_back("(defrule L" + std::to_string(level_) + "::" + made.name + " " + text + (rule.at("mode") == "while" ? " (tick)" : "") +
                     " => (fire " + n + "))");
    out_.rules.push_back(std::move(made));
  }

  const json& in_;
  ClipsProgram out_;
  std::vector<std::string> rules_;
  std::map<std::string, std::uint32_t> cell_of_, level_of_, timer_of_;
  std::map<std::string, std::size_t> asked_;
  std::uint32_t level_ = 0;
  bool in_timer_ = false;
};

}  // namespace

ClipsProgram clips_program(const std::string& json_path) {
  std::ifstream file(json_path);
  if (!file) throw std::runtime_error("cannot read " + json_path);
  const json program = json::parse(file);
  return Writer(program).write();
}

}  // namespace peers
