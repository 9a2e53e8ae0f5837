// The two engines behind one interface, and both at once.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "compiler/tables/tables.h"

namespace kb::trace {

enum class EngineKind : std::uint8_t { kTables, kInterpreter, kBoth };
/// The words for them, in this order.
inline constexpr std::array<std::string_view, 3> kEngineWords{"tables", "interpreter", "both"};
/// Nothing for any other word.
[[nodiscard]] std::optional<EngineKind> find_engine(std::string_view word);

/// Runs a program, tick by tick (with the contract of program::Interpreter).
class Engine {
 public:
  virtual ~Engine() = default;
  virtual program::Tick tick(std::span<const float> facts, std::uint32_t dt_us) = 0;
  [[nodiscard]] virtual float value(program::CellId cell) const = 0;
  /// After a tick: how the engines differ in it, in words; empty if they agree or there is only one.
  [[nodiscard]] virtual const std::string& disagreement() const;
};

/// `program` and `tables` must outlive the engine.
[[nodiscard]] std::unique_ptr<Engine> make_engine(EngineKind kind, const program::Program& program,
                                                  const tables::Tables& tables);
/// The same on an image in place; `program` is what was recalled from it.
[[nodiscard]] std::unique_ptr<Engine> make_engine(EngineKind kind, const program::Program& program,
                                                  const tables::LoadedImage& image);

}  // namespace kb::trace
