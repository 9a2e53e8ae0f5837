// kbc fleet: many drives of one knowledge base in the simulator, in shards that any number of threads and machines share.
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/source/fingerprint.h"
#include "compiler/source/numbers.h"
#include "planners/crew.h"
#include "sim/batch/gate.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/drive_ground.h"
#include "tools/kbc/expected_counts.h"
#include "tools/kbc/fleet_dealer.h"
#include "tools/kbc/fleet_shards.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/library_folder.h"
#include "tools/kbc/row_names.h"
#include "tools/kbc/source_print.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;
using sim::batch::Batch;

constexpr std::uint64_t kLargestSeed = 9'000'000'000'000'000;   // as in a scenario file

struct FleetOptions {
  GroundOptions ground;
  std::vector<std::string> scenarios;
  std::string seeds = "1", share, out, expect;
  std::uint32_t robots = 1;
  unsigned jobs = 0;
  bool merge = false, status = false;
};

/// Shard k is mine if k % of == mine.
struct Share { std::size_t mine = 0, of = 1; };

bool read_pair(std::string_view text, char between, std::uint64_t& first, std::uint64_t& second) {
  const std::size_t at = text.find(between);
  return at != std::string_view::npos && source::read_number(text.substr(0, at), first) && source::read_number(text.substr(at + 1), second);
}

bool read_seeds(const std::string& text, sim::batch::BatchOptions& batch, Session& session) {
  const bool one = source::read_number(text, batch.first_seed);
  if (one) batch.last_seed = batch.first_seed;
  const bool good = one || read_pair(text, '-', batch.first_seed, batch.last_seed);
  if (good && batch.first_seed <= batch.last_seed && batch.last_seed <= kLargestSeed) return true;
  session.report(Kind::kFleetSeeds, {text});
  return false;
}

bool read_share(const std::string& text, Share& share, Session& session) {
  if (text.empty()) return true;
  std::uint64_t mine = 0, of = 0;
  if (read_pair(text, '/', mine, of) && mine >= 1 && mine <= of && of <= sim::batch::kMostRuns) {
    share = {static_cast<std::size_t>(mine - 1), static_cast<std::size_t>(of)};
    return true;
  }
  session.report(Kind::kFleetShare, {text});
  return false;
}

struct NamedFile { std::string path, name; };

/// The scenarios with their names in the results: those given with `FILE=NAME`, else the files' own, made plain. Nothing (reported) if one cannot
/// be a name, or two are the same.
std::optional<std::vector<NamedFile>> named_scenarios(const std::vector<std::string>& options, Session& session) {
  if (options.empty()) return std::vector<NamedFile>{{"", "plain"}};
  std::vector<NamedFile> all;
  for (const std::string& option : options) {
    auto [path, name] = file_and_name(option);
    const bool given = option != path;
    if (!given) name = plain_name(std::filesystem::path(path).stem().string());
    if (const std::string_view why = refused_name(name); !why.empty()) {
      session.report(Kind::kResultName, {name, "scenario", why});
      return std::nullopt;
    }
    for (const NamedFile& other : all) {
      if (other.name != name) continue;
      session.report(Kind::kFleetSameName, {other.path, path, name});
      return std::nullopt;
    }
    all.push_back({std::move(path), std::move(name)});
  }
  return all;
}

/// A batch that can be driven. Does not move.
struct Prepared {
  std::unique_ptr<DriveGround> ground;
  std::unique_ptr<Batch> batch;
  BatchParts parts;
};

bool read_scenarios(const std::vector<NamedFile>& files, const sim::Combinations& set, DriveGround& ground, std::vector<sim::batch::NamedScenario>& scenarios,
                    Session& session) {
  auto messages = session.diagnostics(ground.compiled->sources);
  bool good = true;
  for (const auto& [path, name] : files) {
    for (const std::vector<sim::Setting>& settings : set) {
      auto scene = ground.scene(path, settings, session, messages);
      good = good && scene.has_value() && messages.errors() == 0;
      if (!good) break;
      std::vector<std::string> values;
      for (const sim::Setting& setting : settings) values.push_back(setting.value);
      scenarios.push_back({name, std::move(values), std::move(scene->scenario), std::move(scene->labyrinth)});
    }
  }
  return good;
}

void mix(source::Fingerprint& print, const source::Sources& sources, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) print.mix_file(sources.bytes(source::FileId{static_cast<std::uint32_t>(i)}));
}

// Everything that a row depends on, including the names of scenarios, but no paths: in another folder the batch is the same. The first `rules`
// sources are those of the knowledge base.
BatchParts parts_of(const FleetOptions& options, const sim::batch::BatchOptions& batch, const DriveGround& ground,
                    const std::vector<sim::batch::NamedScenario>& scenarios, std::size_t rules) {
  const auto text = [](const source::Fingerprint& print) { return fmt::format("{:016x}", print.value()); };
  const source::Sources& sources = ground.compiled->sources;
  source::Fingerprint knowledge, what, how;
  mix(knowledge, sources, 0, rules);
  for (const auto& scenario : scenarios) what.mix(scenario.name + "\n");
  mix(what, sources, rules, sources.size());
  how.mix(fmt::format("{} {}\n", batch.dt_us, options.ground.scale.value_or(0.0)));
  for (const std::string& stub : options.ground.stub) how.mix(stub + "\n");
  if (ground.background) how.mix(ground.background->grid.all_moves());
  return {{"kbc", source_print()},
          {"knowledge base", text(knowledge)},
          {"scenarios", text(what)},
          {"seeds", fmt::format("{}-{}", batch.first_seed, batch.last_seed)},
          {"robots", fmt::format("{}", batch.robots)},
          {"options", text(how)}};
}

bool prepare(const FleetOptions& options, Prepared& prepared, Session& session) {
  sim::batch::BatchOptions how;
  how.robots = options.robots;
  if (!read_seeds(options.seeds, how, session)) return false;
  const auto files = named_scenarios(options.scenarios, session);
  if (!files) return false;
  const auto set = combinations(options.ground.set, [](std::string_view key) { return key == "seed" ? "`--seeds` names the seeds" : std::string(); }, session);
  if (!set) return false;
  for (const sim::Setting& setting : set->front()) how.keys.push_back(setting.key);
  const std::uint64_t seeds = how.last_seed - how.first_seed + 1;
  const std::uint64_t each = std::max<std::uint64_t>(options.scenarios.size(), 1) * set->size() * how.robots;
  if (!are_few_enough(seeds, "seeds", each, session)) return false;
  auto compiled = session.compile(options.ground.file, driver::Stage::kTables);
  const std::size_t rules = compiled->sources.size();
  prepared.ground = prepare_ground(options.ground, std::move(compiled), session);
  if (!prepared.ground) return false;
  how.dt_us = prepared.ground->dt_us;
  std::vector<sim::batch::NamedScenario> scenarios;
  if (!read_scenarios(*files, *set, *prepared.ground, scenarios, session)) return false;
  prepared.parts = parts_of(options, how, *prepared.ground, scenarios, rules);
  prepared.batch = std::make_unique<Batch>(*prepared.ground->knowledge, std::move(scenarios), how);
  return true;
}

/// Drives shards until none is left or `stop` is set. A shard that has not been driven to its end is dropped.
void work(const Batch& batch, Dealer& dealer, unsigned thread, const std::atomic<bool>& stop) {
  const auto go_on = [&stop] { return !stop && !Interrupts::came(); };
  while (go_on()) {
    const auto shard = dealer.next(thread);
    if (!shard) return;
    std::string rows;
    const Batch::Block block = batch.block(*shard);
    for (std::size_t number = block.first; number < block.last; ++number) {
      const auto run = batch.drive(number, go_on);
      if (!run) return;
      rows += batch.print(*run) + "\n";
    }
    dealer.take(*shard, rows);
  }
}

std::size_t runs_of(const Batch& batch, const std::vector<std::size_t>& shards) {
  std::size_t runs = 0;
  for (const std::size_t shard : shards) runs += batch.block(shard).last - batch.block(shard).first;
  return runs;
}

/// The number of wanted runs, and how many of them existed before.
struct Wanted { std::size_t all = 0, before = 0; };

/// Drives all missing shards, with the threads of this process and the other ranks, if any. False if some are still missing afterwards.
bool drive_missing(const Prepared& prepared, const BatchFiles& files, const Wanted& wanted, unsigned jobs, Session& session) {
  const Batch& batch = *prepared.batch;
  const std::size_t runs = runs_of(batch, files.missing());
  std::size_t done = 0, shards = 0;
  std::optional<Progress> progress(std::in_place, session, "runs");
  std::string failed, failed_path;
  ListDealer dealer(files.missing(), [&](std::size_t shard, const std::string& rows) {
    const std::string error = files.write(shard, rows);
    if (!error.empty()) {
      failed = error;
      failed_path = files.shard_path(shard);
      return false;
    }
    ++shards;
    done += batch.block(shard).last - batch.block(shard).first;
    progress->show(done, runs);
    return true;
  });
  std::atomic<bool> stop{false};
  Ranks* const ranks = session.launch().ranks;
  std::unique_ptr<Interrupts> interrupts;
  if (ranks == nullptr) interrupts = std::make_unique<Interrupts>();   // the launcher of ranks also ends them
  const unsigned serving = ranks != nullptr ? 1 : 0;
  planners::on_threads(jobs + serving, stop, [&](unsigned thread) {
    if (thread < serving) ranks->serve(dealer);
    else work(batch, dealer, thread - serving, stop);
  });
  progress.reset();   // what is said now has a line of its own
  if (!failed.empty()) session.report(Kind::kCannotWrite, {failed_path, failed});
  else if (shards < files.missing().size())
    session.remark(fmt::format("interrupted: {} of {} runs are kept; the same command goes on", wanted.before + done, wanted.all));
  return shards == files.missing().size();
}

/// Reports (KB1363) each row of the table that is not as expected.
void compare_rows(const std::vector<sim::batch::Demand>& expected, const Batch& batch, const std::vector<sim::batch::Run>& runs, Session& session) {
  for (const auto& unmet : sim::batch::unmet(expected, batch, runs)) {
    const auto& scenario = batch.scenarios()[unmet.row];
    std::string row = scenario.name;
    for (std::size_t i = 0; i < scenario.values.size(); ++i) row += fmt::format(", {}={}", batch.keys()[i], scenario.values[i]);
    session.report(Kind::kFleetUnexpected, {unmet.demand, row, unmet.found});
  }
}

/// Says how much of the batch is there, and prints the table of that.
int tell_status(const Batch& batch, const BatchFiles& files, std::size_t shards, Session& session) {
  auto runs = files.runs(session);
  if (!runs) return kErrors;
  const std::size_t missing = files.missing().size();
  session.print(fmt::format("{} of {} runs are done, {} of {} shards\n\n", runs->size(), batch.runs(), shards - missing, shards) + sim::batch::summarise(batch, *runs));
  return session.exit_code();
}

/// After a share: how far the whole batch is, and what comes next.
void tell_share(const BatchFiles& files, std::size_t shards, Session& session) {
  const std::size_t done = files.done();
  if (files.complete()) return session.remark(fmt::format("the batch is merged already: {}", files.path("runs.csv")));
  const std::string far = done == shards ? fmt::format("all {} are done;", diagnostics::counted(shards, "shard")) : fmt::format("{} of {} shards are done; when all are,", done, shards);
  session.remark(far + " the same command with `--merge` in place of `--shard` puts them together");
}

int lead(const FleetOptions& options, const Share& share, unsigned jobs, Session& session) {
  Prepared prepared;
  const auto expected = expected_counts(options.expect, sim::batch::countable(), session);
  if (!expected || !prepare(options, prepared, session)) return kErrors;
  std::vector<std::size_t> wanted;
  for (std::size_t shard = share.mine; shard < prepared.batch->shards(); shard += share.of) wanted.push_back(shard);
  BatchFiles files(options.out, *prepared.batch, prepared.parts);
  if (!files.open(session, wanted)) return kErrors;
  if (options.status) return tell_status(*prepared.batch, files, wanted.size(), session);
  if (options.merge && !files.missing().empty()) {
    session.report(Kind::kFleetMissing, {fmt::format("{}", files.missing().size()), fmt::format("{}", prepared.batch->shards()), files.shard_path(files.missing().front())});
    return kErrors;
  }
  if (!files.missing().empty()) {
    const std::size_t all = runs_of(*prepared.batch, wanted);
    const Wanted runs{all, all - runs_of(*prepared.batch, files.missing())};
    if (!files.claim(session)) return kErrors;
    if (session.launch().ranks != nullptr) session.launch().ranks->announce(fingerprint_of(prepared.parts));
    if (!drive_missing(prepared, files, runs, jobs, session)) return session.exit_code() != kClean ? kErrors : kInterrupted;
    if (!files.claimed_all(session)) return kErrors;
  }
  if (!options.share.empty()) {
    tell_share(files, prepared.batch->shards(), session);
    return session.exit_code();
  }
  const auto merged = files.merge(session);
  if (!merged) return kErrors;
  session.print(merged->summary);
  compare_rows(*expected, *prepared.batch, merged->runs, session);
  return session.exit_code();
}

/// The work of a rank other than the first: it drives the shards that it gets.
int follow(const FleetOptions& options, unsigned jobs, Ranks& ranks, Session& session) {
  const std::string wanted = ranks.hear();
  if (wanted.empty()) return kClean;
  Prepared prepared;
  if (!prepare(options, prepared, session)) return kErrors;
  if (fingerprint_of(prepared.parts) != wanted) {
    session.report(Kind::kFleetRankOther, {fmt::format("{}", ranks.rank())});
    return kErrors;
  }
  std::atomic<bool> stop{false};
  planners::on_threads(jobs, stop, [&](unsigned thread) { work(*prepared.batch, ranks.dealer(), thread, stop); });
  ranks.leave();
  return session.exit_code();
}

/// Whether a launcher of MPI jobs has started this process, and it is to do more than a given share.
bool is_rank(const FleetOptions& options) {
  if (const char* size = std::getenv("OMPI_COMM_WORLD_SIZE")) return std::string_view(size) != "1";
  for (const char* variable : {"PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {   // one process of `srun` is no job of ranks
    const char* size = std::getenv(variable);
    if (size != nullptr && std::string_view(size) == "1") return false;
  }
  const bool told = !options.share.empty() || options.merge || options.status;
  return !told && (std::getenv("PMIX_RANK") != nullptr || std::getenv("PMI_RANK") != nullptr);
}

/// Replaces this process by the program that is linked with MPI, so that kbc itself need not be. Returns only if there is none.
int hand_over(Session& session) {
  const std::string program = (own_program().parent_path() / "kbc-fleet-mpi").string();
  if (session.launch().argv != nullptr) ::execv(program.c_str(), session.launch().argv);
  session.report(Kind::kFleetNoMpi, {});
  return kErrors;
}

int run_fleet(const FleetOptions& options, Session& session) {
  Ranks* const ranks = session.launch().ranks;
  if (ranks == nullptr && is_rank(options)) return hand_over(session);
  // One thread for each rank: whoever starts ranks has counted the cores.
  const unsigned jobs = options.jobs != 0 ? options.jobs : ranks != nullptr ? 1 : planners::cores();
  if (ranks != nullptr && ranks->rank() != 0) return follow(options, jobs, *ranks, session);
  Share share;
  return read_share(options.share, share, session) ? lead(options, share, jobs, session) : static_cast<int>(kErrors);
}

}  // namespace

Run setup_fleet(CLI::App& app) {
  auto options = std::make_shared<FleetOptions>();
  add_ground_options(app, options->ground);
  app.add_option("--scenario", options->scenarios, "What happens, TOML; may be given often, and with a name for the results; without it nothing is done to the robot")
      ->type_name("FILE=NAME")
      ->allow_extra_args(false);
  app.add_option("--seeds", options->seeds, "Seeds of all noise: one, or the first and the last, 1-100")->type_name("RANGE")->capture_default_str();
  app.add_option("--robots", options->robots, "For each scenario and seed, each with noise of its own; they do not meet")
      ->transform(is_count(1, 1'000'000))
      ->capture_default_str();
  app.add_option("--out", options->out, "The folder for the results; an interrupted batch goes on there")->required()->type_name("DIR");
  app.add_option("--jobs", options->jobs, "How many runs at once (all cores; 1 for each rank of MPI); the results do not depend on it")->transform(is_count(1, 1024));
  auto* share = app.add_option("--shard", options->share, "Drive the i-th of n shares only, and leave the rest to others")->type_name("i/n");
  auto* expect = app.add_option("--expect", options->expect, "Fail unless each row of the table meets this: arrived>=95%,collisions=0")->type_name("DEMAND,...")->excludes(share);
  auto* merge = app.add_flag("--merge", options->merge, "Drive nothing: put the shards together that others have driven")->excludes(share);
  app.add_flag("--status", options->status, "Drive and write nothing: say how much is done, with the table of that")->excludes(share)->excludes(merge)->excludes(expect);
  return [options](Session& session) { return run_fleet(*options, session); };
}

}  // namespace kb::cli
