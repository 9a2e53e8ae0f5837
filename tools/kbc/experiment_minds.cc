#include "tools/kbc/experiment_minds.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "compiler/model/standard_names.h"
#include "compiler/source/fingerprint.h"
#include "sim/mind/control_words.h"
#include "tools/kbc/row_names.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;
namespace lab = sim::experiment;

constexpr std::string_view kMission = "mission.kb";

/// A fingerprint of the rules alone, without names of files and without the map on which they happen to be checked.
std::string fingerprint_of(const source::Sources& sources) {
  source::Fingerprint print;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const source::FileId file{static_cast<std::uint32_t>(i)};
    if (sources.path(file) != kMission) print.mix_file(sources.bytes(file));
  }
  return fmt::format("{:016x}", print.value());
}

/// False (reported) if the rules of `mind` do not drive the mission, or if its scenario cannot be read with one of the settings.
bool check(const lab::Setup& setup, const lab::Prepared& mission, const std::string& mind, std::string& fingerprint, Session& session) {
  const auto compiled = session.compile_text(kMission, mission.mission(mind));
  if (!compiled->ok()) return false;
  fingerprint = fingerprint_of(compiled->sources);
  auto messages = session.diagnostics(compiled->sources);
  if (compiled->model.maps.size() > 1) {
    messages.report(Kind::kExperimentMindMap, {}, {mind});
    return false;
  }
  const auto floor = sim::lay_out(compiled->model, {}, messages);
  model::StandardNames library(session.library(), session.files());
  const auto knowledge = floor ? sim::prepare(compiled->model, compiled->program, compiled->tables, messages, &library) : std::nullopt;
  if (!knowledge) return false;
  sim::report_lacking_sensors(*knowledge, messages);
  return std::all_of(setup.set.begin(), setup.set.end(), [&](const auto& settings) {
    const source::FileId script = compiled->sources.add("scenario.toml", mission.case_of(0, lab::size_of(settings)).scenario);
    const auto set = sim::add_settings(settings, compiled->sources);
    const auto build = sim::read_floor(script, set, messages);
    if (!build) return false;
    const auto sized = sim::lay_out(compiled->model, {build->size * floor->scale, nullptr, *build}, messages);
    const auto scenario = sized ? sim::read_scenario(script, set, *sized, *knowledge, compiled->model, messages) : std::nullopt;
    return scenario && (mind.empty() || sim::check_settings(*knowledge, scenario->body, messages));   // our own rules fit every size
  });
}

}  // namespace

std::optional<std::vector<lab::Method>> read_minds(const std::vector<std::string>& options, Session& session) {
  std::vector<lab::Method> minds;
  const auto refused = [&](const std::string& name, std::string_view why) {
    session.report(Kind::kResultName, {name, "mind", why});
    return std::nullopt;
  };
  for (const std::string& option : options) {
    auto [file, name] = file_and_name(option);
    if (name.empty()) name = std::filesystem::path(file).stem().string();
    if (const std::string_view why = refused_name(name); !why.empty()) return refused(name, why);
    for (const auto& known : {lab::built_in_methods(), minds}) {
      const bool there = std::any_of(known.begin(), known.end(), [&, &wanted = name](const lab::Method& m) { return m.name == wanted; });
      if (there) return refused(name, "there is one already");
    }
    // Otherwise the file would be taken for the mission that imports it.
    if (std::filesystem::path(file).lexically_normal() == kMission) file = std::filesystem::absolute(file).string();
    if (file.find_first_of("\"\n\r") != std::string::npos) {
      session.report(Kind::kCannotRead, {file, "the mission is to import it, and no import can name a file with a quote or a line break in its path"});
      return std::nullopt;
    }
    if (auto read = session.files().read(file); !read.bytes) {   // as an import of the mission it would be reported in a file that nobody wrote
      session.report(Kind::kCannotRead, {file, read.error});
      return std::nullopt;
    }
    session.note_input(file);
    minds.push_back({lab::Method::Control::kMind, name, file});
  }
  return minds;
}

std::optional<lab::Results::Minds> check_minds(const lab::Setup& setup, const std::vector<lab::Method>& minds, Session& session) {
  lab::Results::Minds fingerprints;
  if (minds.empty() && setup.set.front().empty()) return fingerprints;
  const lab::Group group = lab::groups_of(setup).front();
  const lab::Ground ground = lab::ground_of_number(setup, group.labyrinth, session.files());
  const lab::Prepared mission(setup, group, ground, session.files());
  std::string fingerprint;
  if (minds.empty() && !check(setup, mission, {}, fingerprint, session)) return std::nullopt;
  for (const lab::Method& mind : minds) {
    if (!check(setup, mission, mind.mind, fingerprint, session)) return std::nullopt;
    fingerprints.emplace(mind.name, fingerprint);
  }
  return fingerprints;
}

}  // namespace kb::cli
