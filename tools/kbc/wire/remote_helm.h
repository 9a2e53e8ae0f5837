// The simulated robot's end of the conversation: an external program at the wheel.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/drive/helm.h"
#include "sim/mind/knowledge.h"
#include "tools/kbc/wire/answer.h"
#include "tools/kbc/wire/driver_process.h"

namespace kb::wire {

struct RemoteOptions {
  std::string command;                    ///< for messages
  std::uint32_t dt_us = 100'000;          ///< of the simulator's ticks
  int within_ms = 10'000;                 ///< for one answer
  std::function<void(std::string_view)> on_mind{};   ///< called with each tick that the driver reports, as JSON, unchanged
};

class RemoteHelm final : public sim::Helm {
 public:
  /// `knowledge` must outlive it: names in answers are looked up in it.
  RemoteHelm(std::unique_ptr<DriverProcess> process, const sim::Knowledge& knowledge, RemoteOptions options);

  void press(program::CellId fact, bool held) override;
  void release(program::CellId fact) override;
  [[nodiscard]] mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const sim::TagHeard& tag, float dt_s) override;
  [[nodiscard]] sim::Judge::Belief belief() const override;
  /// As reported last.
  [[nodiscard]] std::optional<bool> mission() const override { return answer_.mission; }
  [[nodiscard]] const std::string& goal() const override { return answer_.goal; }
  [[nodiscard]] std::vector<std::string> reports() const override;
  [[nodiscard]] bool high(program::CellId cell) const override;
  [[nodiscard]] bool seen(program::CellId fact) const override;
  [[nodiscard]] bool ticks_with_next_period() const override { return true; }
  [[nodiscard]] bool gone() const override { return failure_.has_value(); }

  /// Why it no longer answers; nothing while it does.
  [[nodiscard]] const std::optional<Mistake>& failure() const { return failure_; }

 private:
  [[nodiscard]] bool exchange(const std::string& line);
  void fail(Mistake mistake, std::string report);
  void fail(LineChannel::Came came);
  void garbled(std::string why);
  /// The time since the drive began, for messages.
  [[nodiscard]] std::string at() const;

  std::unique_ptr<DriverProcess> process_;
  const sim::Knowledge& knowledge_;
  RemoteOptions options_;
  Answer answer_;
  std::string text_;                      // of the answer
  std::vector<program::CellId> seen_;
  struct Button { program::CellId fact{}; int ticks = 0; };   // 0: until it is released
  std::vector<Button> pressed_;
  std::int64_t now_us_ = 0;
  std::optional<Mistake> failure_;
  std::string report_;                    // of the failure
};

}  // namespace kb::wire
