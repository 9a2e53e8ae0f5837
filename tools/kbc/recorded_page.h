// A run on recorded facts as a page: see sim/report/report.h. There is no floor on it.
#pragma once

#include <cstdint>
#include <string>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "sim/drive/mind_names.h"
#include "sim/recording.h"
#include "tools/kbc/trace/engine.h"

namespace kb::cli {

class RecordedPage {
 public:
  /// A longer recording makes a page that no browser shows.
  static constexpr std::uint64_t kMostTicks = 300'000;

  /// `program` must outlive it.
  RecordedPage(const program::Program& program, std::string title);
  /// A tick that the engine has just made. False: there are too many. O(facts + strategies + changes).
  [[nodiscard]] bool add(const program::Tick& tick, const trace::Engine& engine);
  /// `outcome`: what stands beside the title.
  [[nodiscard]] std::string html(std::string outcome);

 private:
  const program::Program& program_;
  sim::Recording recording_;
  sim::CellChanges changes_;
};

}  // namespace kb::cli
