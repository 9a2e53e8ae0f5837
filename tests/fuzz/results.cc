// Any bytes as the rows of `kbc fleet` (the first byte is `f`) and as the file of results of `kbc experiment`. What is read is summed up and
// drawn; and is written as it will be read again.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/batch.h"
#include "sim/experiment/results.h"
#include "sim/experiment/summary.h"
#include "tests/fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace kb::sim;

void read_batch(std::string_view bytes) {
  static const Knowledge nothing;
  std::vector<batch::NamedScenario> scenarios;
  for (const char* value : {"0.1", "0.2"}) {
    batch::NamedScenario named;
    named.name = "plain";
    named.values = {value};
    scenarios.push_back(std::move(named));
  }
  batch::BatchOptions options;
  options.last_seed = 3;
  options.robots = 2;
  options.keys = {"sensors.range.noise"};
  const batch::Batch all(nothing, std::move(scenarios), options);
  std::vector<batch::Run> runs;
  for (std::size_t number = 0; number < all.runs(); ++number) {
    const std::string_view line = kb::take_line(bytes);
    // Where the line is not of this run, the fields are tried with the beginning that it has to have.
    const std::string blank = all.print(all.run(number));
    auto run = all.parse(line, number);
    if (!run) run = all.parse(blank.substr(0, blank.find(",,")) + std::string(line), number);
    if (!run) run = all.run(number);
    else if (const std::string again = all.print(*run); !all.parse(again, number) || all.print(*all.parse(again, number)) != again) std::abort();
    if (run->outcome.empty()) run->outcome = "stuck";
    runs.push_back(std::move(*run));
  }
  static_cast<void>(batch::summarise(all, runs));
}

void read_experiment(std::string_view bytes) {
  experiment::Setup setup;
  setup.set = rows_of({{"seed", {"1", "2"}}, {"sensors.range.noise", {"0.1", "0.01"}}});
  const std::string mark = "# fuzz", header = mark + "\n" + experiment::row_header(setup.set) + "\n";
  const kb::MemoryFile file(header + std::string(bytes));
  std::string printed;
  {
    experiment::Results results;
    const auto opened = results.open(file.path(), mark, setup);
    if (opened != experiment::Results::Opened::kOpen) std::abort();
    printed = results.print();
    const auto rows = results.sorted();
    const auto shares = experiment::summarise(rows);
    static_cast<void>(experiment::print_table(shares, setup.set));
    static_cast<void>(experiment::print_kinds(rows, setup.set));
    static_cast<void>(experiment::draw_outcomes(shares, setup.set));
    static_cast<void>(experiment::draw_times(shares, setup.set));
  }
  const kb::MemoryFile again(printed);
  experiment::Results results;
  static_cast<void>(results.open(again.path(), mark, setup));
  if (results.print() != printed) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with('f')) read_batch(bytes.substr(1));
  else read_experiment(bytes);
  return 0;
}
