// Packed tables in memory, and the machine that runs the runtime's engine on them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <waymark/runtime/image_check_rules.h>
#include "compiler/diagnostics/diagnostics.h"
#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "compiler/tables/form.h"

namespace kb::tables {

class LoadedImage;

/// The sizes above which the engine uses its mechanisms for large programs. They change cost, never results.
struct Limits {
  std::size_t large_group = 64;  ///< exclusive groups of more members are cleared through a list of live members
  std::size_t broad = 32;        ///< an atom read in more words of rules than this (and than any key wakes) asks every awake rule instead
  std::size_t longest = mts::image::kMaxConditions;  ///< the longest condition written out; for a longer one, a node counts the parts that hold
  std::size_t crowd = 64;        ///< an atom that more rules read than this is a rule's key only if the rule has no other as rare
};

/// From this many rules on a second thread pays; in a smaller program it costs more than it saves.
inline constexpr std::size_t kWorthAThread = 20'000;

/// The program as packed tables (form.h). Pure; O(program).
[[nodiscard]] Tables build(const program::Program& program, const Limits& limits = {});

/// One item a line, stable: for `kbc dump tables`.
[[nodiscard]] std::string print(const Tables& tables, const program::Program& program);

/// What a knowledge base costs: emitted as C++, or as an image, which has neither masks nor a compact form.
struct Budget {
  std::size_t table_bytes = 0;        ///< read-only
  std::size_t state_bytes = 0;        ///< memory that the caller owns
  std::size_t compact_state_bytes = 0; ///< the same in compact form; 0: it has none
  std::size_t mask_bytes = 0;         ///< read-only, besides the tables, of emitted code that is compiled for speed
  std::size_t name_bytes = 0;         ///< the text of names, without a pointer to each; only if names are linked in
  std::size_t perception_table_bytes = 0, perception_state_bytes = 0;   ///< the same for perception, readings and texts included
  std::size_t perception_stack_bytes = 0;   ///< temporary stack of putting a fact together
  std::size_t fuzzy_table_bytes = 0;  ///< of all fuzzy controllers, read-only
  std::size_t fuzzy_stack_bytes = 0;  ///< temporary stack of evaluating the largest one by its tables
  std::uint32_t facts = 0, satellites = 0, strategies = 0, rules = 0, atoms = 0, nodes = 0, timers = 0;
  std::uint32_t counted = 0;          ///< rules whose condition is so long that a node counts the parts that hold
  std::uint32_t most_awake = 0;       ///< how many of `rules` can be awake at once (exclusive groups counted once)
};
[[nodiscard]] Budget budget(const Tables& tables, const program::Program& program, bool image = false);

/// The runtime's engine (the very code that robots run) on tables in memory, speaking `program::Tick`.
/// `program` and `tables` must outlive it. Same contract as program::Interpreter.
class Machine {
 public:
  Machine(const program::Program& program, const Tables& tables);
  /// Runs on the bytes of an image in place (image.h), with the image's width of indexes; it must outlive the machine.
  Machine(const program::Program& program, const LoadedImage& image);
  ~Machine();
  Machine(Machine&&) noexcept;
  Machine& operator=(Machine&&) = delete;

  program::Tick tick(std::span<const float> facts, std::uint32_t dt_us);
  void reset();
  /// Takes another mind between two ticks: the machine's state carries over by name, see note [what carries over]. Both images
  /// must belong to their programs and outlive the machine. Throws std::logic_error if this machine does not run on an image.
  void take(const program::Program& program, const LoadedImage& image);
  [[nodiscard]] float value(program::CellId cell) const;
  void poke(program::CellId satellite, float value);
  [[nodiscard]] bool seen(program::CellId fact) const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace kb::tables
