#include "tools/kbc/trace/engine.h"

#include <fmt/format.h>

#include "compiler/program/interpret.h"
#include "tools/kbc/trace/trace_diff.h"

namespace kb::trace {
namespace {

using program::CellId;
using program::Program;
using program::Tick;

template <class Runner>
class Single final : public Engine {
 public:
  template <class... Arguments>
  explicit Single(Arguments&... arguments) : runner_(arguments...) {}
  Tick tick(std::span<const float> facts, std::uint32_t dt_us) override { return runner_.tick(facts, dt_us); }
  [[nodiscard]] float value(CellId cell) const override { return runner_.value(cell); }

 private:
  Runner runner_;
};

// Both engines on the same facts. Ticks are compared, and the cells that a tick lists as set.
class Both final : public Engine {
 public:
  template <class Knowledge>
  Both(const Program& program, const Knowledge& knowledge)
      : program_(program), interpreter_(program), machine_(program, knowledge) {}

  Tick tick(std::span<const float> facts, std::uint32_t dt_us) override {
    Tick tick = machine_.tick(facts, dt_us);
    const Tick oracle = interpreter_.tick(facts, dt_us);
    if (!(tick == oracle))
      disagreement_ = in_words(compare_ticks(print_json(program_, oracle), print_json(program_, tick)));
    for (const CellId cell : tick.active) {
      if (disagreement_.empty() && machine_.value(cell) != interpreter_.value(cell))
        disagreement_ = "the value of `" + std::string(program_[cell].name) + "`";
    }
    return tick;
  }
  [[nodiscard]] float value(CellId cell) const override { return machine_.value(cell); }
  [[nodiscard]] const std::string& disagreement() const override { return disagreement_; }

 private:
  static std::string in_words(const std::vector<std::string>& differences) {
    return differences.empty() ? "what the trace does not show" : fmt::format("{}", fmt::join(differences, "; "));
  }
  const Program& program_;
  program::Interpreter interpreter_;
  tables::Machine machine_;
  std::string disagreement_;
};

}  // namespace

const std::string& Engine::disagreement() const {
  static const std::string none;
  return none;
}

std::optional<EngineKind> find_engine(std::string_view word) {
  const auto found = std::find(kEngineWords.begin(), kEngineWords.end(), word);
  if (found == kEngineWords.end()) return std::nullopt;
  return static_cast<EngineKind>(found - kEngineWords.begin());
}

namespace {

template <class Knowledge>
std::unique_ptr<Engine> make_engine_on(EngineKind kind, const Program& program, const Knowledge& knowledge) {
  switch (kind) {
    case EngineKind::kInterpreter: return std::make_unique<Single<program::Interpreter>>(program);
    case EngineKind::kBoth: return std::make_unique<Both>(program, knowledge);
    case EngineKind::kTables: break;
  }
  return std::make_unique<Single<tables::Machine>>(program, knowledge);
}

}  // namespace

std::unique_ptr<Engine> make_engine(EngineKind kind, const Program& program, const tables::Tables& tables) {
  return make_engine_on(kind, program, tables);
}

std::unique_ptr<Engine> make_engine(EngineKind kind, const Program& program, const tables::LoadedImage& image) {
  return make_engine_on(kind, program, image);
}

}  // namespace kb::trace
