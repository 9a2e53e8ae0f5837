#include "tests/unit/sim/laboratory.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "compiler/diagnostics/consumers.h"

namespace kb::sim::testing {
namespace {

std::string path_of(std::string_view path) { return std::string(KB_PROJECT_ROOT) + "/" + std::string(path); }

std::unique_ptr<driver::Compilation> compile(std::string_view path, const source::FileSystem& files, const std::string& library) {
  driver::Options options;
  options.library = library;
  options.analyse = false;
  std::string said;
  auto compiled = driver::compile(path, files, options, diagnostics::ErrorLines::make, &said);
  if (!compiled->ok()) throw std::runtime_error(said);
  return compiled;
}

}  // namespace

std::string project_file(std::string_view path) {
  std::ifstream in(path_of(path), std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + std::string(path));
  std::ostringstream bytes;
  bytes << in.rdbuf();
  return bytes.str();
}

std::unique_ptr<Laboratory> Laboratory::of_text(std::string_view text, const LayoutOptions& layout) {
  source::MemoryFileSystem files;
  for (const auto& entry : std::filesystem::directory_iterator(path_of("stdlib_rules/std"))) {
    const std::string name = "stdlib_rules/std/" + entry.path().filename().string();
    files.add(name, project_file(name));
  }
  files.add("mission.kb", std::string(text));
  auto made = std::make_unique<Laboratory>();
  made->compiled = compile("mission.kb", files, "stdlib_rules");
  made->lay_out_all(layout);
  return made;
}

std::unique_ptr<Laboratory> Laboratory::of_file(std::string_view path, const LayoutOptions& layout) {
  auto made = std::make_unique<Laboratory>();
  made->compiled = compile(path_of(path), source::RealFileSystem(), path_of("stdlib_rules"));
  made->lay_out_all(layout);
  return made;
}

void Laboratory::lay_out_all(const LayoutOptions& layout) {
  diagnostics::ErrorLines listener(compiled->sources, said_);
  diagnostics::Diagnostics messages(compiled->sources, listener);
  labyrinth = lay_out(compiled->model, layout, messages);
  knowledge = prepare(compiled->model, compiled->program, compiled->tables, messages);
  if (!labyrinth || !knowledge) throw std::runtime_error(said_);
}

Scenario Laboratory::scenario(std::string_view text) {
  diagnostics::ErrorLines listener(compiled->sources, said_);
  diagnostics::Diagnostics messages(compiled->sources, listener);
  auto read = read_scenario(compiled->sources.add("scenario.toml", std::string(text)), {}, *labyrinth, *knowledge, compiled->model, messages);
  if (!read) throw std::runtime_error(said_);
  return std::move(*read);
}

Scenario Laboratory::plain() { return scenario(""); }

Summary Laboratory::drive(const Scenario& scenario, Recording* recording) const {
  DriveOptions options;
  options.recording = recording;
  return Drive(*labyrinth, *knowledge, scenario, options).run();
}

std::string Laboratory::trace(const Scenario& scenario) const {
  std::string lines;
  DriveOptions options;
  options.on_tick = [&](const program::Tick& tick) { lines += print_json(compiled->program, tick) + "\n"; };
  static_cast<void>(Drive(*labyrinth, *knowledge, scenario, options).run());
  return lines;
}

}  // namespace kb::sim::testing
