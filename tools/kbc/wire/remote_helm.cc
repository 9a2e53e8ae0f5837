#include "tools/kbc/wire/remote_helm.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compiler/source/reason.h"
#include "compiler/source/utf8.h"
#include "tools/kbc/wire/fields.h"
#include "tools/kbc/wire/line.h"

namespace kb::wire {

using diagnostics::Kind;

RemoteHelm::RemoteHelm(std::unique_ptr<DriverProcess> process, const sim::Knowledge& knowledge, RemoteOptions options)
    : process_(std::move(process)), knowledge_(knowledge), options_(std::move(options)) {}

void RemoteHelm::press(program::CellId fact, bool held) { pressed_.push_back({fact, held ? 0 : sim::kPressTicks}); }

void RemoteHelm::release(program::CellId fact) {
  std::erase_if(pressed_, [&](const Button& button) { return button.fact == fact; });
}

/// The driver has failed: mission and leg stay as they were, but nothing runs and nothing is seen any more.
void RemoteHelm::fail(Mistake mistake, std::string report) {
  failure_ = std::move(mistake);
  report_ = std::move(report);
  answer_.strategy.clear();
  seen_.clear();
  if (process_ != nullptr) process_->fail();
  process_.reset();
}

void RemoteHelm::fail(LineChannel::Came came) {
  using Came = LineChannel::Came;
  if (came == Came::kStopped) return fail({}, "Driver.interrupted");   // after an interrupt there is neither a message nor an ending
  if (came == Came::kLate) return fail({Kind::kDriverSilent, {options_.command, fmt::format("{:g}", options_.within_ms / 1000.0), at()}, {}}, "Driver.silent");
  if (came == Came::kTooLong) return garbled(fmt::format("a line of more than {} bytes", kLongestLine));
  const std::string how = came == Came::kEnd ? process_->end() : source::reason(process_->channel().error());
  fail({Kind::kDriverEnded, {options_.command, how, at()}, {}}, "Driver.ended");
}

void RemoteHelm::garbled(std::string why) { fail({Kind::kDriverAnswer, {options_.command, at(), std::move(why)}, {}}, "Driver.garbled"); }

std::string RemoteHelm::at() const { return fmt::format("{:.2f}", static_cast<double>(now_us_) / 1e6); }

bool RemoteHelm::exchange(const std::string& line) {
  using Came = LineChannel::Came;
  LineChannel& channel = process_->channel();
  if (channel.holds_more()) {   // otherwise every answer would belong to the line before
    const bool whole = channel.read(text_, 0) == Came::kLine;
    return garbled("nobody had asked for it: " + source::printable(whole ? text_ : "")), false;
  }
  if (const Came went = channel.write(line, options_.within_ms); went != Came::kLine) return fail(went), false;
  if (const Came came = channel.read(text_, options_.within_ms); came != Came::kLine) return fail(came), false;
  auto read = read_answer(text_);
  if (const auto* mistake = std::get_if<Mistake>(&read)) return garbled(fmt::format("{}: {}", message_of(*mistake), source::printable(text_))), false;
  const std::optional<bool> mission = answer_.mission;
  answer_ = std::move(std::get<Answer>(read));
  if (!answer_.mission) answer_.mission = mission;   // as in the answer to a line that could not be used: no mission begins or ends by it
  return true;
}

mts::Motion RemoteHelm::step(std::int64_t now_us, const mts::Senses& senses, const sim::TagHeard& tag, float /*dt_s*/) {
  now_us_ = now_us;
  if (failure_) return {};
  std::vector<std::string> buttons;
  for (const Button& button : pressed_) buttons.emplace_back(knowledge_.program->cells[program::index(button.fact)].name);
  if (!exchange(print_line(now_us, senses, tag, buttons))) return {};
  const bool first_of_tick = (now_us - sim::kStepUs) % options_.dt_us == 0;
  if (first_of_tick) {
    std::erase_if(pressed_, [](Button& button) { return button.ticks > 0 && --button.ticks == 0; });
  }
  if (answer_.seen) {
    seen_.clear();
    for (const std::string& name : *answer_.seen) {
      if (const program::CellId cell = knowledge_.find(name); cell != program::CellId::kNone) seen_.push_back(cell);
    }
  }
  if (!answer_.mind.empty() && options_.on_mind) options_.on_mind(answer_.mind);
  return answer_.wheels;
}

sim::Judge::Belief RemoteHelm::belief() const {
  sim::Judge::Belief belief;
  for (const sim::Leg& leg : knowledge_.legs) {
    if (!answer_.leg.empty() && leg.name == answer_.leg) belief.leg = &leg;
  }
  for (const sim::Strategy& strategy : knowledge_.strategies) {
    if (!answer_.strategy.empty() && strategy.name == answer_.strategy) belief.strategy = &strategy;
  }
  belief.driving = belief.strategy != nullptr && belief.strategy->drives();
  belief.reports = failure_ || std::any_of(answer_.reports.begin(), answer_.reports.end(), [](const std::string& report) { return report != "Help.power"; });
  return belief;
}

std::vector<std::string> RemoteHelm::reports() const { return failure_ ? std::vector{report_} : answer_.reports; }

bool RemoteHelm::high(program::CellId cell) const {
  const std::string_view name = knowledge_.program->cells[program::index(cell)].name;
  return name == answer_.leg || name == answer_.strategy;
}

bool RemoteHelm::seen(program::CellId fact) const { return std::find(seen_.begin(), seen_.end(), fact) != seen_.end(); }

}  // namespace kb::wire
