// Any bytes as a scenario, behind lines `--set KEY=VALUE,...`: of the labyrinth, or of the hall if they speak of one. What is read is driven
// for a few seconds.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/driver/compile.h"
#include "sim/drive/drive.h"
#include "sim/scenario/setting.h"
#include "tests/fuzz/reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using namespace kb;

struct Ground {
  std::unique_ptr<driver::Compilation> compiled;
  std::optional<sim::Knowledge> knowledge;
};

Ground ground_of(const char* file) {
  driver::Options options;
  options.library = KB_LIBRARY;
  options.analyse = false;
  Ground made{driver::compile(file, source::RealFileSystem(), options, diagnostics::CountingConsumer::make, nullptr), {}};
  Reading in;
  if (made.compiled->ok()) made.knowledge = sim::prepare(made.compiled->model, made.compiled->program, made.compiled->tables, in.messages);
  if (!made.knowledge) std::abort();
  return made;
}

/// What the command line refuses is passed over.
std::vector<sim::Sweep> take_sweeps(std::string_view& bytes) {
  constexpr std::string_view kSet = "--set ";
  std::vector<sim::Sweep> sweeps;
  while (bytes.starts_with(kSet)) {
    std::string why;
    auto sweep = sim::read_sweep(take_line(bytes).substr(kSet.size()), why);
    if (sweep && sweep->values.size() <= 3 && sweeps.size() < 4) sweeps.push_back(std::move(*sweep));
  }
  return sweeps;
}

void drive(const Ground& ground, const sim::Labyrinth& labyrinth, const sim::Scenario& scenario) {
  sim::Recording recording;
  sim::DriveOptions how;
  how.recording = &recording;
  sim::Drive drive(labyrinth, *ground.knowledge, scenario, how);
  for (int tick = 0; tick < 30 && drive.step(); ++tick) {
  }
}

void read(const Ground& ground, const std::string& toml, const std::vector<sim::Setting>& row) {
  Reading in;
  const auto settings = sim::add_settings(row, in.sources);
  const auto file = in.sources.add("scenario.toml", toml);
  auto build = sim::read_floor(file, settings, in.messages);
  if (build.has_value() == in.messages.failed()) std::abort();   // read, or told why not
  if (!build) return;
  sim::LayoutOptions layout;
  layout.build = std::move(*build);
  const auto labyrinth = sim::lay_out(ground.compiled->model, layout, in.messages);
  if (labyrinth.has_value() == in.messages.failed()) std::abort();
  if (!labyrinth) return;
  const auto scenario = sim::read_scenario(file, settings, *labyrinth, *ground.knowledge, ground.compiled->model, in.messages);
  if (scenario.has_value() == in.messages.failed()) std::abort();
  if (scenario) drive(ground, *labyrinth, *scenario);
  Reading again;
  const auto again_settings = sim::add_settings(row, again.sources);
  static_cast<void>(sim::read_robot(again.sources.add("robot.toml", toml), again_settings, *labyrinth, *ground.knowledge, again.messages));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Ground labyrinth = ground_of(KB_EXAMPLES "/04_simulator/route1.kb"), hall = ground_of(KB_EXAMPLES "/07_open_hall/bug.kb");
  std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const Ground& ground = bytes.find("[[hall") != std::string_view::npos ? hall : labyrinth;
  const auto rows = sim::rows_of(take_sweeps(bytes));
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), 3); ++i) read(ground, std::string(bytes), rows[i]);
  return 0;
}
