// kbc compare: the same runs before and after a change.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "compiler/diagnostics/display.h"
#include "sim/batch/compare.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/expected_counts.h"
#include "tools/kbc/named_files.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/stream.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

constexpr std::size_t kMostResultBytes = std::size_t{4} << 30;

struct CompareOptions {
  std::string before, after, between, csv, expect;
  std::uint64_t most = 10;
};

/// Results, and the bytes that they are views of.
struct Loaded {
  std::string bytes;
  sim::batch::Results results;
};

/// The results of a folder, or of its `runs.csv`. Null (reported) if there are none.
std::unique_ptr<Loaded> read_side(const std::string& named, Session& session) {
  std::error_code ignored;
  const std::string path = std::filesystem::is_directory(named, ignored) ? (std::filesystem::path(named) / "runs.csv").string() : named;
  std::string error;
  auto bytes = trace::read_all(path, kMostResultBytes, error);
  if (!bytes) {
    session.report(Kind::kCannotRead, {path, error.empty() ? "is too large" : error});
    return nullptr;
  }
  auto loaded = std::make_unique<Loaded>(Loaded{std::move(*bytes), {}});
  session.note_input(path);
  auto read = sim::batch::read_results(loaded->bytes);
  if (const auto* fault = std::get_if<sim::batch::ResultsFault>(&read)) {
    source::Sources sources;
    const auto file = sources.add(path, loaded->bytes);
    session.diagnostics(sources).report(Kind::kCompareNoResults, {file, static_cast<std::uint32_t>(fault->begin), static_cast<std::uint32_t>(fault->end)}, {fault->what});
    return nullptr;
  }
  loaded->results = std::get<sim::batch::Results>(std::move(read));
  return loaded;
}

/// `method=mts,quick`. Nothing (reported) if it is written otherwise.
std::optional<sim::batch::Between> read_between(const std::string& text, Session& session) {
  if (text.empty()) return sim::batch::Between{};
  const std::size_t equals = text.find('='), comma = text.find(',', equals);
  if (equals != 0 && comma != std::string::npos && text.find(',', comma + 1) == std::string::npos) {
    return sim::batch::Between{text.substr(0, equals), text.substr(equals + 1, comma - equals - 1), text.substr(comma + 1)};
  }
  session.report(Kind::kCompareBetween, {text});
  return std::nullopt;
}

/// What is compared, in a few lines.
std::string head_of(const CompareOptions& options, const sim::batch::Comparison& comparison) {
  const auto runs = [](std::size_t count) { return diagnostics::counted(count, "run"); };
  std::string out = fmt::format("OLD is {}, NEW is {}{}\n", options.before, options.after.empty() ? options.before : options.after,
                                options.between.empty() ? "" : fmt::format("; {}", options.between));
  if (!comparison.differ.empty()) out += fmt::format("they differ in: {}\n", fmt::join(comparison.differ, ", "));
  out += fmt::format("{} in both", runs(comparison.pairs.size()));
  if (comparison.only_before + comparison.only_after > 0) out += fmt::format(", {} in OLD only, {} in NEW only", comparison.only_before, comparison.only_after);
  return out + "\n\n";
}

int run(const CompareOptions& options, Session& session) {
  const auto demands = expected_counts(options.expect, sim::batch::kPairDemands, session);
  if (!demands) return kErrors;
  const auto between = read_between(options.between, session);
  if (!between) return kErrors;
  if (options.after.empty() && options.between.empty()) {
    session.report(Kind::kCompareOneSide, {});
    return kErrors;
  }
  const auto before = read_side(options.before, session);
  const auto other = options.after.empty() ? nullptr : read_side(options.after, session);
  if (before == nullptr || (!options.after.empty() && other == nullptr)) return kErrors;
  const auto compared = sim::batch::compare(before->results, (other ? other : before)->results, *between);
  if (const auto* fault = std::get_if<std::string>(&compared)) {
    session.report(Kind::kCompareApart, {*fault});
    return kErrors;
  }
  const auto& comparison = std::get<sim::batch::Comparison>(compared);
  if (!options.csv.empty() && !session.write_files({{options.csv, sim::batch::print_pairs(comparison)}})) return kErrors;
  session.print(head_of(options, comparison) + sim::batch::summarise(comparison, static_cast<std::size_t>(options.most)));
  for (const auto& unmet : sim::batch::unmet(*demands, comparison)) {
    session.report(Kind::kFleetUnexpected, {unmet.demand, sim::batch::name_of(comparison, comparison.rows[unmet.row]), unmet.found});
  }
  return session.exit_code();
}

}  // namespace

Run setup_compare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  app.add_option("OLD", options->before, "Results of `kbc fleet` or `kbc experiment`: the folder, or its runs.csv")->required();
  app.add_option("NEW", options->after, "The other ones; may be missing with --between");
  app.add_option("--between", options->between, "OLD are the runs with the first value in this column, NEW those with the second; both may be of one folder")->type_name("COLUMN=OLD,NEW");
  app.add_option("--csv", options->csv, "Write a row for each pair of runs")->type_name("FILE")->check([](const std::string& path) {
    return is_standard_output(path) ? std::string("standard output is for the table; name a file") : std::string();
  });
  app.add_option("--most", options->most, "The most runs to list of each kind; the others are counted")->type_name("N")->transform(is_whole_number("count"))->capture_default_str();
  app.add_option("--expect", options->expect, "Fail unless each row of the table meets this: lost=0,collisions=0")->type_name("DEMAND,...");
  app.parse_complete_callback([options] {
    if (options->before == "-" && options->after == "-") throw CLI::ValidationError("NEW", "standard input is read once");
  });
  return [options](Session& session) { return run(*options, session); };
}

}  // namespace kb::cli
