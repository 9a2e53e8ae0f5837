#include "tests/unit/program/random_program.h"

#include <cstdlib>
#include <cmath>
#include <limits>
#include <string>

#include "tests/unit/dice.h"
#include "tests/unit/program/program_builder.h"

namespace kb::program::testing {
namespace {

class Random : public tests::Dice {
 public:
  using Dice::Dice;
  std::size_t between(std::size_t least, std::size_t most) { return least + below(most - least + 1); }
  bool chance(unsigned percent) { return below(100) < percent; }
  template <class T>
  const T& pick(const std::vector<T>& items) {
    return items[below(items.size())];
  }
};

const std::vector<std::uint32_t> kTimes = {0, 1'000, 50'000, 100'000, 150'000, 200'000, 300'000, 1'000'000};

/// No call has two arguments that draw: compilers evaluate them in orders of their own, and a seed would be another program with each.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed), calm_(random_.chance(60)), builder_(levels()) {}

  Program run() {
    settings();
    declare_cells();
    declare_groups();
    const std::size_t rules = random_.chance(8) ? random_.between(60, 300) : random_.between(1, 30);
    for (std::size_t i = 0; i < rules; ++i) add_rule("r" + std::to_string(i));
    return builder_.build();
  }

 private:
  std::vector<std::string> levels() {
    const std::size_t count = random_.between(1, 5);
    for (std::size_t i = 0; i < count; ++i) levels_.push_back("L" + std::to_string(i));
    return levels_;
  }

  void settings() {
    Settings& s = builder_.settings;
    s.firing = random_.chance(3) ? 1.0 : random_.pick<double>({0.5, 0.5, 0.5, 0.25, 0.3, 0.6, 0.75});
    s.event = random_.chance(3) ? 1.0 : random_.pick<double>({0.75, 0.75, 0.5, 0.8, 0.3});
    s.attention = random_.pick<double>({0.25, 0.25, 0.1, 0.0, 0.3});
    s.hold_limit_us = random_.pick(kTimes);
  }

  void declare_cells() {
    const std::size_t facts = random_.between(1, 8);
    for (std::size_t i = 0; i < facts; ++i) {
      const std::string name = "F" + std::to_string(i);
      if (random_.chance(25)) {
        const double own = random_.pick<double>({0.6, 0.9, 0.5, 0.0, 1.0});
        builder_.fact(name, own, own * random_.pick<double>({0.0, 0.1, 0.5, 1.0}));
      } else {
        builder_.fact(name, random_.chance(20) ? 1.0f : -1.0f);
      }
      facts_.push_back(name);
      satellites_.push_back("sat " + name);
    }
    const std::size_t strategies = random_.chance(2) ? random_.between(33, 70) : random_.between(1, 6);
    for (std::size_t i = 0; i < strategies; ++i) {
      const std::string name = "U" + std::to_string(i);
      builder_.strategy(name);
      strategies_.push_back(name);
      satellites_.push_back("sat " + name);
    }
    const std::size_t states = random_.chance(5) ? random_.between(40, 150) : random_.between(1, 12);
    for (std::size_t i = 0; i < states; ++i) declare_satellite("S" + std::to_string(i));
    const std::size_t policy = random_.below(4);
    builder_.idle(policy == 0 ? random_.pick(strategies_) : policy == 1 ? "stop" : "hold");
  }

  void declare_satellite(const std::string& name) {
    const bool keep = random_.chance(15);
    builder_.satellite(name, random_.chance(70) ? -1.0f : value(), keep);
    if (random_.chance(30)) builder_.of(name, random_.pick(random_.chance(70) ? facts_ : strategies_));
    satellites_.push_back(name);
    states_.push_back(name);
  }

  /// Some of the free satellites, neighbours or not, in groups; and perhaps some facts, as a promise.
  void declare_groups() {
    std::vector<std::vector<std::string>> groups(random_.between(1, 3));
    const bool one_large = states_.size() >= 40;
    for (const std::string& name : states_) {
      if (one_large ? random_.chance(90) : random_.chance(60))
        groups[one_large ? 0 : random_.below(groups.size())].push_back(name);
    }
    for (std::vector<std::string>& group : groups) {
      if (group.empty()) continue;
      if (group.size() > 1) groups_.push_back(group);
      builder_.exclusive(std::move(group));
    }
    if (random_.chance(30) && facts_.size() > 2) builder_.exclusive({facts_[0], facts_[2]});
  }

  float value() {
    const auto firing = static_cast<float>(builder_.settings.firing);
    return random_.pick<float>(
        {1.0f, -1.0f, 0.0f, 0.5f, -0.5f, 0.3f, -0.7f, firing, -firing, 1.0f - firing, std::nextafter(firing, 0.0f)});
  }

  Expression leaf() {
    const std::size_t kind = random_.below(20);
    if (kind < 3) return seen(random_.pick(facts_));
    if (kind < 5) return event(random_.pick(facts_));
    if (kind < 6) return lost(random_.pick(facts_));
    const std::string& name = kind < 10   ? random_.pick(facts_)
                              : kind < 12 ? random_.pick(strategies_)
                                          : random_.pick(satellites_);
    const std::size_t term = random_.below(10);
    return term < 6 ? high(name) : term < 8 ? low(name) : zero(name);
  }

  std::vector<Expression> several(std::size_t depth) {
    std::vector<Expression> parts(random_.chance(3) ? 0 : random_.between(1, 4));
    for (Expression& part : parts) part = expression(depth);
    return parts;
  }

  Expression any_of_group() {
    std::vector<Expression> parts;
    for (const std::string& name : groups_.empty() ? satellites_ : random_.pick(groups_)) parts.push_back(high(name));
    return any(std::move(parts));
  }

  Expression expression(std::size_t depth) {
    const std::size_t kind = random_.below(20);
    if (depth == 0 || kind < 9) return leaf();
    if (kind < 12) return all(several(depth - 1));
    if (kind < 14) return any(several(depth - 1));
    if (kind < 17) return no(expression(depth - 1));
    if (kind == 19) return any_of_group();
    const std::uint32_t time_us = random_.pick(kTimes);
    return held(expression(depth - 1), time_us);
  }

  /// Parts that recur from rule to rule, as they do in knowledge bases: shared nodes and timers.
  Expression part() {
    if (!recurring_.empty() && random_.chance(25)) return random_.pick(recurring_);
    Expression made = expression(random_.between(0, 4));
    if (random_.chance(20)) recurring_.push_back(made);
    return made;
  }

  /// In a calm program the rules of one level mostly agree: each satellite is raised by some levels, lowered by others.
  NamedEffect calm_effect(std::size_t level) {
    const std::size_t place = random_.below(satellites_.size());
    return (place + level) % 2 == 0 ? raise(satellites_[place]) : lower(satellites_[place]);
  }

  void add_effects(std::size_t level, std::vector<NamedEffect>& effects) {
    if (calm_ && !random_.chance(5)) return effects.push_back(calm_effect(level));
    const std::size_t kind = random_.below(20);
    if (kind == 0 && random_.chance(30)) {
      effects.push_back(reset_all());
    } else if (kind == 1 && !groups_.empty()) {
      for (const std::string& name : random_.pick(groups_)) effects.push_back(lower(name));
    } else if (kind < 10) {
      effects.push_back(raise(random_.pick(satellites_)));
    } else if (kind < 16) {
      effects.push_back(lower(random_.pick(satellites_)));
    } else {
      const float given = value();
      effects.push_back(assign(random_.pick(satellites_), given));
    }
  }

  void add_rule(const std::string& name) {
    std::vector<Expression> parts(random_.chance(60) ? 1 : random_.between(2, 3));
    for (Expression& one : parts) one = part();
    const std::size_t level = random_.below(levels_.size());
    std::vector<NamedEffect> effects;
    for (std::size_t i = random_.between(1, 4); i > 0; --i) add_effects(level, effects);
    if (random_.chance(65)) {
      builder_.when(name, levels_[level], all(std::move(parts)), std::move(effects));
    } else {
      builder_.while_true(name, levels_[level], all(std::move(parts)), std::move(effects));
    }
  }

  Random random_;
  bool calm_;
  std::vector<std::string> levels_;
  ProgramBuilder builder_;
  std::vector<std::string> facts_, strategies_, satellites_, states_;
  std::vector<std::vector<std::string>> groups_;
  std::vector<Expression> recurring_;
};

std::vector<float> telling_values(const Program& program, const Cell& fact) {
  const auto firing = static_cast<float>(program.settings.firing);
  const Thresholds limits = thresholds(fact);
  std::vector<float> values = {-1.0f, -0.6f, 0.0f, 0.0f, 0.4f, 0.6f, 0.9f, 1.0f, 1.0f};
  for (const float exact : {firing, -firing, 1.0f - firing, limits.plain, limits.attended}) {
    values.push_back(exact);
    values.push_back(std::nextafter(exact, 2.0f));
    values.push_back(std::nextafter(exact, -2.0f));
  }
  return values;
}

float strange_value(Random& random) {
  return random.pick<float>({std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(), 1.5f, -2.0f, -0.0f,
                             std::numeric_limits<float>::denorm_min()});
}

}  // namespace

Program random_program(std::uint64_t seed) { return Generator(seed).run(); }

std::vector<Step> random_trace(const Program& program, std::uint64_t seed, std::size_t ticks) {
  Random random(seed ^ 0x5DEECE66Dull);
  std::vector<std::vector<float>> values;
  for (std::uint32_t i = 0; i < program.facts; ++i) values.push_back(telling_values(program, program.cells[i]));
  const unsigned restlessness = static_cast<unsigned>(random.pick<int>({5, 20, 40, 80}));

  std::vector<Step> steps;
  std::vector<float> now(program.facts, 0.0f);
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (random.chance(restlessness)) now[i] = random.chance(2) ? strange_value(random) : random.pick(values[i]);
    }
    steps.push_back({now, random.pick(kTimes)});
  }
  return steps;
}

std::uint64_t count_from(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace kb::program::testing
