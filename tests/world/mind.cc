#include "tests/world/mind.h"

#include <fmt/format.h>

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

}  // namespace

std::unique_ptr<Mind> make_mind(MindKind kind, const Knowledge& knowledge) {
  switch (kind) {
    case MindKind::kInterpreter:
      return std::make_unique<MindOf<program::Interpreter>>(program::Interpreter(knowledge.program()));
    case MindKind::kMachine:
      return std::make_unique<MindOf<tables::Machine>>(tables::Machine(knowledge.program(), knowledge.tables()));
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
