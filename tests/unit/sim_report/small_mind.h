// A mind small enough to write down by hand, run by the tick of docs/language.md: what it records is right by construction.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/recording.h"

namespace kb::sim::testing {

/// Builds names, conditions and rules by name. Facts first, then satellites, then strategies.
class MindBuilder {
 public:
  std::uint32_t fact(const std::string& name, float initial = 0.0f);
  std::uint32_t satellite(const std::string& name, float initial = -1.0f);
  /// A strategy with its satellite `sat NAME` must have been added before as `of`.
  std::uint32_t strategy(const std::string& name, std::uint32_t of, const std::string& control);
  [[nodiscard]] std::uint32_t cell(const std::string& name) const;

  std::uint32_t is(const std::string& name, MindNames::Condition::Term term = MindNames::Condition::Term::kHigh);
  std::uint32_t about(MindNames::Condition::Op op, const std::string& name);   ///< kEvent, kLost, kSeen
  std::uint32_t all(std::vector<std::uint32_t> parts);
  std::uint32_t any(std::vector<std::uint32_t> parts);
  std::uint32_t no(std::uint32_t part);
  std::uint32_t lasting(std::uint32_t part, double duration_s);

  MindNames::Rule& rule(const std::string& name, const std::string& level, std::uint32_t condition, std::vector<MindNames::Write> writes);
  MindNames names;

 private:
  std::uint32_t add(MindNames::Condition condition);
  std::uint32_t line_ = 1;
};

/// Runs it. Rules stand in the order of their levels; there are no conflicts.
class SmallMind {
 public:
  explicit SmallMind(const MindNames& names);
  /// The facts' values, by cell; fills `changed`, `events`, `lost`, `fired`, `strategy`, `status` of the frame.
  void tick(const std::vector<float>& facts, Frame& frame);
  [[nodiscard]] float value(std::uint32_t cell) const { return values_[cell]; }

 private:
  [[nodiscard]] bool holds(std::uint32_t condition, double t_s);
  void look(Frame& frame);
  void run_level(std::uint32_t level, Frame& frame);

  const MindNames& names_;
  std::vector<float> values_, before_;
  std::vector<bool> seen_, event_, lost_, armed_;
  std::vector<double> since_;   // by condition: a timer; negative: not held
  bool first_ = true;
};

}  // namespace kb::sim::testing
