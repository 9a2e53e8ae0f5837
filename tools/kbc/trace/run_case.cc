// One case of `kbc test`: runs it and compares the trace with the expected one.
#include <fmt/format.h>

#include <cerrno>
#include <memory>
#include <optional>

#include "compiler/source/reason.h"
#include "tools/kbc/trace/trace_diff.h"
#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/trace/facts_csv.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/senses.h"
#include "tools/kbc/trace/test_cases.h"

namespace kb::trace {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;
using Outcome = CaseResult::Outcome;

// The expected trace, line by line; blank lines do not count.
class Expected {
 public:
  /// `lenient`: a file that is not a trace just differs, because it is about to be overwritten.
  Expected(const std::string& path, bool lenient, source::Sources& sources, Diagnostics& diagnostics)
      : path_(path),
        lenient_(lenient),
        sources_(sources),
        diagnostics_(diagnostics),
        stream_(open_stream(path, error_)) {
    if (stream_) lines_.emplace(*stream_);
  }
  [[nodiscard]] bool there() const { return stream_ != nullptr; }
  /// Why it is not there.
  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] bool failed() const { return failed_; }

  /// The next line, or nothing at the end. A line equal to `actual` is not examined further.
  std::optional<std::string_view> next(std::string_view actual) {
    while (lines_ && !failed_) {
      const auto line = lines_->next();
      if (!line) {
        if (const std::string error = stream_->error(); !error.empty()) reject(Kind::kCannotRead, {}, {path_, error});
        return std::nullopt;
      }
      if (line->text.empty()) continue;
      if (lenient_ || line->text == actual) return line->text;
      const std::string fault =
          line->too_long ? fmt::format("it has more than {} bytes", LineReader::kMaxLineBytes) : tick_fault(line->text);
      if (fault.empty()) return line->text;
      reject(Kind::kTraceNotJson, excerpt(sources_, path_, *line, 0, 1), {fault});
    }
    return std::nullopt;
  }

 private:
  void reject(Kind kind, source::Span span, std::initializer_list<std::string_view> arguments) {
    diagnostics_.report(kind, span, arguments);
    failed_ = true;
  }
  const std::string& path_;
  bool lenient_;
  source::Sources& sources_;
  Diagnostics& diagnostics_;
  std::string error_;
  std::unique_ptr<ByteStream> stream_;
  std::optional<LineReader> lines_;
  bool failed_ = false;
};

// The engine under test and, if coverage is counted, also the interpreter.
class Player {
 public:
  Player(const program::Program& program, const tables::Tables& tables, const CaseOptions& options)
      : engine_(make_engine(options.engine, program, tables)), senses_(program, options.engine), coverage_(options.coverage) {
    if (coverage_ == nullptr) return;
    interpreter_.emplace(program);
    interpreter_->observe(coverage_);
    coverage_->begin_run();
  }
  program::Tick tick(const FactsRow& row) {
    const auto facts = senses_.look(row, [&](program::CellId cell) { return engine_->value(cell); });
    if (coverage_ != nullptr) {
      coverage_->before(*interpreter_);
      coverage_->after(interpreter_->tick(facts, row.dt_us), *interpreter_);
    }
    program::Tick tick = engine_->tick(facts, row.dt_us);
    tick.perceived = senses_.changed();
    return tick;
  }
  [[nodiscard]] const std::string& disagreement() const {
    return senses_.disagreement().empty() ? engine_->disagreement() : senses_.disagreement();
  }

 private:
  std::unique_ptr<Engine> engine_;
  Senses senses_;
  Coverage* coverage_;
  std::optional<program::Interpreter> interpreter_;
};

enum class End : std::uint8_t { kWhole, kReported, kStopped };

// Runs all rows and compares each tick; also writes them to `written` if the trace may be updated.
End compare(FactsReader& reader, Player& player, const program::Program& program, Expected& expected,
            TraceDiffer& differ, OutputFile* written, bool (*stop)(), Diagnostics& diagnostics) {
  while (const FactsRow* row = reader.next()) {
    if (stop != nullptr && stop()) return End::kStopped;
    const program::Tick tick = player.tick(*row);
    if (!player.disagreement().empty()) {
      diagnostics.report(Kind::kEnginesDisagree, {}, {fmt::format("{}", tick.number), player.disagreement()});
      return End::kReported;
    }
    const std::string line = with_keys(print_json(program, tick), reader.options().compare);
    if (written != nullptr) {
      written->write(line);
      written->write("\n");
    }
    const auto known = expected.next(line);
    const std::string wanted = known ? with_keys(*known, reader.options().compare) : std::string();
    differ.compare(known ? std::optional<std::string_view>(wanted) : std::nullopt, line);
    if (expected.failed()) return End::kReported;
  }
  if (reader.failed()) return End::kReported;
  while (const auto line = expected.next({})) differ.compare(line, std::nullopt);
  return expected.failed() ? End::kReported : End::kWhole;
}

}  // namespace

CaseResult run_case(const TestCase& test, const program::Program& program, const tables::Tables& tables,
                    const CaseOptions& options, source::Sources& sources, Diagnostics& diagnostics) {
  CaseResult result;
  std::string error;
  const auto bytes = open_stream(test.facts, error);
  if (!bytes) {
    diagnostics.report(Kind::kCannotRead, {}, {test.facts, error});
    return result;
  }
  FactsReader reader(test.facts, *bytes, program, sources, diagnostics,
                     test.readings ? FactsReader::Columns::kReadings : FactsReader::Columns::kFacts);
  if (!reader.open()) return result;
  Expected expected(test.trace, options.update, sources, diagnostics);
  if (!expected.there() && expected.error() != source::reason(ENOENT)) {
    diagnostics.report(Kind::kCannotRead, {}, {test.trace, expected.error()});
    return result;
  }
  OutputFile written;
  if (options.update && !written.open(test.trace)) {
    diagnostics.report(Kind::kCannotWrite, {}, {test.trace, written.error()});
    return result;
  }
  Player player(program, tables, options);
  TraceDiffer differ;
  const End end = compare(reader, player, program, expected, differ, options.update ? &written : nullptr, options.stop, diagnostics);
  if (end == End::kStopped) result.outcome = Outcome::kStopped;
  if (end != End::kWhole) return result;
  result.ticks = reader.rows();
  if (result.ticks == 0) {   // it could never fail
    diagnostics.report(Kind::kTestNoRows, {}, {test.facts});
  } else if (!expected.there() && !options.update) {
    diagnostics.report(Kind::kTestNoExpected, {}, {test.trace});
  } else if (differ.same() && expected.there()) {
    result.outcome = Outcome::kPassed;
  } else if (!options.update) {
    result.outcome = Outcome::kFailed;
    result.report = differ.report();
  } else if (written.commit()) {
    result.outcome = Outcome::kUpdated;
  } else {
    diagnostics.report(Kind::kCannotWrite, {}, {test.trace, written.error()});
  }
  return result;
}

}  // namespace kb::trace
