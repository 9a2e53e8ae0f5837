#include "tests/world/mind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "compiler/program/interpret.h"
#include "compiler/tables/tables.h"

namespace kb::world {
namespace {

/// Interpreter and Machine have the same members; this gives them the same face.
template <class Engine>
class MindOf final : public Mind {
 public:
  explicit MindOf(Engine engine) : engine_(std::move(engine)) {}
  program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) override { return engine_.tick(facts, dt_us); }
  [[nodiscard]] float value(program::CellId cell) const override { return engine_.value(cell); }
  void poke(program::CellId satellite, float value) override { engine_.poke(satellite, value); }
  void reset() override { engine_.reset(); }

 private:
  Engine engine_;
};

class LockStep final : public Mind {
 public:
  LockStep(const Knowledge& knowledge, std::unique_ptr<Mind> oracle, std::unique_ptr<Mind> engine)
      : knowledge_(knowledge), oracle_(std::move(oracle)), engine_(std::move(engine)) {}

  program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) override {
    const program::Tick want = oracle_->tick(facts, dt_us);
    program::Tick got = engine_->tick(facts, dt_us);
    if (got != want) {
      throw MindsDiffer(fmt::format("the engine differs from the interpreter\n  interpreter {}\n  engine      {}",
                                    program::print_json(knowledge_.program(), want),
                                    program::print_json(knowledge_.program(), got)));
    }
    return got;
  }
  [[nodiscard]] float value(program::CellId cell) const override {
    const float want = oracle_->value(cell);
    const float got = engine_->value(cell);
    if (got != want) {
      throw MindsDiffer(fmt::format("the engine has {} = {}, the interpreter {}", knowledge_.name(cell), got, want));
    }
    return got;
  }
  void poke(program::CellId satellite, float value) override {
    oracle_->poke(satellite, value);
    engine_->poke(satellite, value);
  }
  void reset() override {
    oracle_->reset();
    engine_->reset();
  }

 private:
  const Knowledge& knowledge_;
  std::unique_ptr<Mind> oracle_, engine_;
};

/// Landmarks as lazy facts: see note [waiting for a fact] in compiler/program/perception.h.
class LazyLandmarks final : public Mind {
 public:
  LazyLandmarks(const Knowledge& knowledge, std::unique_ptr<Mind> mind) : mind_(std::move(mind)), firing_(static_cast<float>(knowledge.program().settings.firing)) {
    const std::vector<program::CellId> order = program::cell_order(knowledge.model());
    for (const model::Map& map : knowledge.model().maps) {
      for (const model::RowId row : map.landmarks) landmarks_.push_back(order[model::index(knowledge.model()[row].cell)]);
    }
    alternatives_ = program::alternatives(knowledge.program(), landmarks_);
  }

  program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) override {
    std::vector<float> seen(facts.begin(), facts.end());
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      if (program::index(landmarks_[i]) < seen.size() && !awaited(alternatives_[i])) seen[program::index(landmarks_[i])] = 0.0f;
    }
    return mind_->tick(seen, dt_us);
  }
  [[nodiscard]] float value(program::CellId cell) const override { return mind_->value(cell); }
  void poke(program::CellId satellite, float value) override { mind_->poke(satellite, value); }
  void reset() override { mind_->reset(); }

 private:
  [[nodiscard]] bool awaited(const program::Alternatives& alternatives) const {
    return std::any_of(alternatives.begin(), alternatives.end(), [this](const auto& demands) {
      return std::all_of(demands.begin(), demands.end(), [this](const program::Demand& demand) {
        const float x = mind_->value(demand.cell);
        const bool is = demand.term == program::Term::kHigh  ? x >= firing_
                        : demand.term == program::Term::kLow ? x <= -firing_
                                                             : 1.0f - std::fabs(x) >= firing_;
        return is != demand.negated;
      });
    });
  }

  std::unique_ptr<Mind> mind_;
  float firing_;
  std::vector<program::CellId> landmarks_;
  std::vector<program::Alternatives> alternatives_;   // of each landmark
};

}  // namespace

std::unique_ptr<Mind> make_mind(MindKind kind, const Knowledge& knowledge) {
  switch (kind) {
    case MindKind::kInterpreter:
      return std::make_unique<MindOf<program::Interpreter>>(program::Interpreter(knowledge.program()));
    case MindKind::kMachine:
      return std::make_unique<MindOf<tables::Machine>>(tables::Machine(knowledge.program(), knowledge.tables()));
    case MindKind::kLazyLandmarks:
      return std::make_unique<LazyLandmarks>(knowledge, make_mind(MindKind::kMachine, knowledge));
    case MindKind::kBoth: break;
  }
  return make_lock_step(knowledge, make_mind(MindKind::kInterpreter, knowledge),
                        make_mind(MindKind::kMachine, knowledge));
}

std::unique_ptr<Mind> make_lock_step(const Knowledge& knowledge, std::unique_ptr<Mind> oracle,
                                     std::unique_ptr<Mind> engine) {
  return std::make_unique<LockStep>(knowledge, std::move(oracle), std::move(engine));
}

MindKind mind_from_environment() {
  const char* asked = std::getenv("KB_MIND");
  const std::string_view word = asked ? asked : "";
  if (word == "interpreter") return MindKind::kInterpreter;
  if (word == "machine") return MindKind::kMachine;
  return MindKind::kBoth;
}

}  // namespace kb::world
