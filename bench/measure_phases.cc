// What each phase of the compiler takes of a large knowledge base, one after another, on one thread: `kbc compile --emit image`
// does some of them at the same time. Prints the table of docs/large.md.
//
//   build/bench/bench/measure_phases city.kb
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "compiler/analysis/analysis.h"
#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"

namespace {

using namespace kb;

/// Memory that this process has now, in MB.
long resident_mb() {
  std::ifstream statm("/proc/self/statm");
  long pages = 0, resident = 0;
  statm >> pages >> resident;
  return resident * 4096 / 1'000'000;
}

double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class Phases {
 public:
  Phases() { fmt::print("| phase | time | processor time | memory at its end |\n|---|---|---|---|\n"); }
  void end(std::string_view name) {
    const double wall = seconds(CLOCK_MONOTONIC), processor = seconds(CLOCK_PROCESS_CPUTIME_ID);
    fmt::print("| {} | {:.2f} s | {:.2f} s | {} MB |\n", name, wall - wall_, processor - processor_, resident_mb());
    wall_ = seconds(CLOCK_MONOTONIC);
    processor_ = seconds(CLOCK_PROCESS_CPUTIME_ID);
  }
  ~Phases() {
    rusage all{};
    getrusage(RUSAGE_SELF, &all);
    fmt::print("\nPeak: {} MB.\n", all.ru_maxrss * 1024 / 1'000'000);
  }
  Phases(const Phases&) = delete;
  Phases& operator=(const Phases&) = delete;

 private:
  double wall_ = seconds(CLOCK_MONOTONIC), processor_ = seconds(CLOCK_PROCESS_CPUTIME_ID);
};

void measure(std::string_view path) {
  const source::RealFileSystem files;
  driver::Compilation to;
  diagnostics::CountingConsumer consumer;
  const diagnostics::WarningOptions warnings;
  diagnostics::Diagnostics diagnostics(to.sources, consumer, warnings);
  Phases phases;

  to.forest = model::load(path, LIBRARY, files, to.sources, diagnostics);
  phases.end("files to trees");
  to.model = model::resolve(to.forest, diagnostics);
  to.forest = {};
  model::forget_details(to.model);
  phases.end("trees to model");
  to.program = program::lower(to.model, to.sources);
  model::forget_rules(to.model);
  if (diagnostics.broken() || !program::verify(to.program).empty()) std::exit(1);
  phases.end("model to program, verified");
  analysis::diagnose(to.model, to.program, {}, diagnostics);
  to.model = {};
  phases.end("analysis");
  to.tables = tables::build(to.program);
  phases.end("tables");
  const std::string image = tables::write_image(to.tables, to.program);
  phases.end("image");
  if (tables::verify_image(image) != mts::ImageStatus::kOk) std::exit(1);
  phases.end("image verified");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: measure_phases FILE.kb\n");
    return 2;
  }
  mallopt(M_MMAP_THRESHOLD, 64 << 20);   // as kbc compile does
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_ARENA_MAX, 1);
  measure(argv[1]);
}
