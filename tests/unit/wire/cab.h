// `kbc drive` without its process, as tests talk to it.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "tools/kbc/wire/exchange.h"

namespace kb::wire {

inline constexpr std::string_view kTown = R"(
import std.navigation
map Town {
    landmark Inn  at (0, 0)
    landmark Well at (3, 0)
    landmark Mill at (6, 0)
    road Inn.E -- Well.W by mark
    road Well.E -- Mill.W by mark
}
command Go
fact Fire
sensor load  0..50 noise 0.5 stale 2 s
sensor badge text
sensor range[10] 0..4 m
fact Loaded = load ~ ramp(5, 10)
fact Anna   = badge ~ "anna"
fact Far    = range[8] ~ ramp(1 m, 2 m)
route Errand on Town by Go: Well -> Mill
)";

/// A knowledge base at the wheel.
class Cab {
 public:
  explicit Cab(ExchangeOptions options = {}) {
    driver::Options how;
    how.library = KB_PROJECT_ROOT "/stdlib_rules";
    compiled_ = driver::compile("town.kb", source::OneFileMore("town.kb", kTown, files_), how, diagnostics::ErrorLines::make, &said_);
    diagnostics::ErrorLines lines(compiled_->sources, said_);
    diagnostics::Diagnostics messages(compiled_->sources, lines);
    labyrinth_ = sim::lay_out(compiled_->model, {}, messages);
    knowledge_ = sim::prepare(compiled_->model, compiled_->program, compiled_->tables, messages);
    if (!said_.empty()) throw std::runtime_error(said_);
    exchange_.emplace(*knowledge_, *labyrinth_, robot_, std::move(options));
  }
  /// The answer to a line, which is always one object in one line.
  nlohmann::json say(std::string_view line) {
    const std::string answer = exchange_->answer(line, ++lines_);
    EXPECT_EQ(answer.find('\n'), std::string::npos);
    const nlohmann::json json = nlohmann::json::parse(answer);
    EXPECT_TRUE(json.contains("speed") && json.contains("turn")) << answer;
    if (exchange_->mistake()) {
      EXPECT_EQ(json["speed"], 0) << answer;
      EXPECT_EQ(json["turn"], 0) << answer;
      EXPECT_EQ(json["error"]["line"], lines_);
      EXPECT_TRUE(json["error"]["column"] >= 1 && json["error"]["column"] <= line.size() + 1) << answer;
    }
    return json;
  }
  /// The same of senses all of which are there: on a line, nothing near, at rest, looking east.
  nlohmann::json say(double t_s, std::string_view more = "") {
    return say(fmt::format(R"({{"t":{},"line":[0.05,0.05,0.95,0.05,0.05],"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_x_m":0,"odometry_y_m":0,)"
                           R"("odometry_m_s":0,"odometry_turned_rad":0,"touched":false,"tag":{{}}{}}})", t_s, more));
  }

  [[nodiscard]] const Exchange& exchange() const { return *exchange_; }
  [[nodiscard]] bool line_was_taken() const { return exchange_->line().has_value(); }

 private:
  source::RealFileSystem files_;
  std::string said_;
  std::unique_ptr<driver::Compilation> compiled_;
  std::optional<sim::Labyrinth> labyrinth_;
  std::optional<sim::Knowledge> knowledge_;
  sim::Scenario robot_;
  std::optional<Exchange> exchange_;
  std::uint64_t lines_ = 0;
};

/// On its way, at 1 s.
inline void set_off(Cab& cab, double from_s = 0.0) {
  for (int i = 0; i < 50; ++i) static_cast<void>(cab.say(from_s + 0.02 * i, i >= 20 && i < 30 ? R"(,"buttons":["Go"])" : ""));
}

/// Whether the last tick of `answer` saw the fact.
inline bool saw(const nlohmann::json& answer, std::string_view fact) {
  const nlohmann::json& seen = answer["seen"];
  return std::find(seen.begin(), seen.end(), fact) != seen.end();
}

/// The code of what is warned of with a line; empty if nothing is.
inline std::string warned(const Cab& cab) { return cab.exchange().warning() ? diagnostics::code_text(cab.exchange().warning()->kind) : ""; }

}  // namespace kb::wire
