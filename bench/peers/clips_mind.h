// A mind whose rules CLIPS matches: the program of clips_program.h in an environment of its own, and around it what CLIPS has
// no words for. See note [what CLIPS does and what the program around it does].
#pragma once

#include <cstdint>
#include <vector>

#include "bench/peers/clips_fact.h"
#include "bench/peers/clips_program.h"
#include "bench/peers/robot.h"

namespace peers {

class ClipsMind {
 public:
  /// `program` must outlive the mind. Throws std::runtime_error if CLIPS does not accept it.
  explicit ClipsMind(const ClipsProgram& program);
  ~ClipsMind();
  ClipsMind(const ClipsMind&) = delete;
  ClipsMind& operator=(const ClipsMind&) = delete;

  /// Back to start-up.
  void reset();
  void give(Fact fact, float value);
  /// The strategy that drives, or kNoStrategy.
  Strategy tick(std::uint32_t dt_us);
  /// The rules that fired on the last tick, by their numbers, from the highest level to the lowest, ascending in a level.
  [[nodiscard]] const std::vector<std::uint32_t>& fired() const { return fired_; }
  /// Rules of one level wrote opposite values to a cell: this mind cannot say what comes of it.
  [[nodiscard]] bool contradicted() const { return contradicted_; }

  // what the CLIPS program calls
  void fire(std::uint32_t rule) { fired_.push_back(rule); }
  void set_timer(std::uint32_t timer, bool on);

 private:
  static constexpr std::uint32_t kNobody = 0xFFFFFFFFu;
  struct Terms { std::uint32_t high = kNobody, zero = kNobody, low = kNobody, seen = kNobody, event = kNobody, lost = kNobody; };

  void build();
  void stand(std::uint32_t asked, bool now);
  void notice();
  void set_cell(std::uint32_t cell, float value);
  void attend(std::uint32_t satellite, int by);
  void run_module(void* module);
  void run_level(std::uint32_t level);
  void commit(std::uint32_t level, std::size_t first);

  const ClipsProgram& p_;
  void* environment_ = nullptr;
  void* tick_template_ = nullptr;
  void* tick_fact_ = nullptr;
  std::vector<void*> level_modules_, timer_modules_;
  std::vector<ClipsFact> stands_;        ///< by asked
  std::vector<Terms> terms_;             ///< by cell
  std::vector<std::uint32_t> held_;      ///< by timer: what is asked of it
  std::vector<float> value_;
  std::vector<int> attended_;
  std::vector<std::uint8_t> seen_, changed_;
  std::vector<std::uint32_t> to_look_at_, momentary_, fired_;
  std::vector<std::int64_t> since_;      ///< by timer; -1: off
  std::vector<std::uint32_t> writer_;    ///< by cell: the number of the commit that wrote it last
  std::vector<std::uint32_t> on_;        ///< strategies that ran
  std::uint32_t commits_ = 0;
  std::int64_t now_us_ = 0;
  bool first_ = true, contradicted_ = false;
};

}  // namespace peers
