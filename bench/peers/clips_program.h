// A knowledge base as a CLIPS program. Made from the JSON of `kbc dump program --json`, so it says the same by construction;
// that it also decides the same is checked tick by tick.
//
// note [what CLIPS does and what the program around it does]
// CLIPS keeps what is true as facts and matches the rules with Rete: a template for each thing that a condition can ask
// (`high-Gate`, `seen-Line`, `event-Start1`), which is the quickest form for it, a module for each level, and its
// refraction for `when`. It has no words for attention, for `C for d`, and for levels that write all at once; those are in
// C++ (clips_mind.h), where they cost next to nothing. So what is measured is CLIPS at its best.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace peers {

/// What a condition asks of a cell, or of a timer.
struct Asked {
  enum class Kind : std::uint8_t { kHigh, kZero, kLow, kSeen, kEvent, kLost, kHeld };
  Kind kind;
  std::uint32_t of;          ///< number of the cell, or of the timer
  std::string template_name; ///< of the CLIPS fact that stands while it is so
};

struct ClipsProgram {
  struct Cell { std::string name; bool fact, strategy; float initial, plain, attended; std::vector<std::uint32_t> draws; };
  struct Timer { std::uint32_t level; std::int64_t duration_us; };
  struct Write { std::uint32_t cell; float value; };
  struct Rule { std::string name; bool resets; std::vector<Write> writes; };

  std::vector<Cell> cells;     ///< `draws`, of a satellite: the facts that it draws attention to
  std::vector<Asked> asked;
  std::vector<Timer> timers;
  std::vector<Rule> rules;     ///< in the order of the JSON; the CLIPS program calls `(fire NUMBER)`
  std::uint32_t levels = 0;
  float firing = 0.5f;
  std::vector<std::string> constructs;  ///< the program: templates, modules `L0`... and `T0`..., rules
};

/// Throws std::runtime_error if the text is not such JSON, or uses what this form cannot say: a timer within a timer.
[[nodiscard]] ClipsProgram clips_program(const std::string& json_path);

}  // namespace peers
