#include "tools/kbc/experiment_show.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "tools/kbc/trace/stream.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;
namespace lab = sim::experiment;

/// False (reported) if there is a file with other contents: the user has not named it, so it must not be overwritten.
bool may_make(const Session::OutputFile& file, Session& session) {
  std::error_code ignored;
  if (!std::filesystem::exists(file.path, ignored)) return true;
  std::string error;
  if (trace::read_all(file.path, file.bytes.size(), error) == file.bytes) return true;
  session.report(Kind::kCannotWrite, {file.path, "it is there already and says something else; remove it, or name another folder"});
  return false;
}

}  // namespace

const lab::Method* method_to_show(const lab::Setup& setup, const std::vector<std::string>& named, Session& session) {
  const auto drives_by_rules = [](const lab::Method& method) { return method.control == lab::Method::Control::kMind; };
  const auto is_own = [](const lab::Method& method) { return !method.mind.empty(); };
  const auto& methods = setup.methods;   // those that were named, if any were
  if (!named.empty() && methods.size() > 1) {
    session.report(Kind::kExperimentNoMission, {fmt::format("`{}` and `{}` are two methods; name one", methods[0].name, methods[1].name)});
    return nullptr;
  }
  const auto own = std::find_if(methods.begin(), methods.end(), is_own);
  const lab::Method& chosen = own != methods.end() ? *own : methods.front();
  if (drives_by_rules(chosen)) return &chosen;
  session.report(Kind::kExperimentNoMission, {fmt::format("`{}` is a program and has none", chosen.name)});
  return nullptr;
}

int show_scenario(const lab::Setup& setup, const lab::Method& method, std::uint32_t scenario, const std::string& folder, Session& session) {
  std::error_code ignored;
  const std::string mind = method.mind.empty() ? std::string() : std::filesystem::proximate(method.mind, folder, ignored).generic_string();
  const auto in_folder = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  for (const lab::Group& group : lab::groups_of(setup)) {
    if (std::find(group.scenarios.begin(), group.scenarios.end(), scenario) == group.scenarios.end()) continue;
    const lab::Ground ground = lab::ground_of_number(setup, group.labyrinth, session.files());
    const lab::Prepared prepared(setup, group, ground, session.files());
    const auto& settings = setup.set.front();
    const std::vector<Session::OutputFile> files{{in_folder("mission.kb"), prepared.mission(mind, lab::size_of(settings))},
                                                 {in_folder("scenario.toml"), prepared.scenario_text(scenario, settings)}};
    const bool free = std::all_of(files.begin(), files.end(), [&](const auto& file) { return may_make(file, session); });
    return free && session.write_files(files) ? session.exit_code() : static_cast<int>(kErrors);
  }
  session.report(Kind::kExperimentNoScenario, {fmt::format("{}", scenario), fmt::format("{}", setup.scenarios)});
  return kErrors;
}

}  // namespace kb::cli
