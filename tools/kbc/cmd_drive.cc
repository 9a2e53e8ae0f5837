// kbc drive: a knowledge base drives a robot of somebody's own, over standard input and output.
#include <fmt/format.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "compiler/program/text.h"
#include "compiler/source/reason.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/drive_ground.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/wire/describe.h"
#include "tools/kbc/wire/exchange.h"
#include "tools/kbc/wire/fields.h"
#include "tools/kbc/wire/line_channel.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct DriveCommand {
  GroundOptions ground;
  std::string robot, record, facts, trace;
  std::string pause = "500ms";
  bool describe = false;
};

/// What is written down while it drives, if somebody wants it.
struct Written {
  std::unique_ptr<trace::OutputFile> record, facts, trace;
};

bool open_written(std::unique_ptr<trace::OutputFile>& file, const std::string& path, Session& session) {
  if (path.empty()) return true;
  file = std::make_unique<trace::OutputFile>();
  return session.open_output(*file, path);
}

bool commit(std::unique_ptr<trace::OutputFile>& file, const std::string& path, Session& session) {
  if (file == nullptr || file->commit()) return true;
  session.report(Kind::kCannotWrite, {path, file->error()});
  return false;
}

/// A name in a header of CSV.
std::string header_name(const std::string& name) { return name.find_first_of(",[\"") == std::string::npos ? name : "\"" + name + "\""; }

void write_facts_header(trace::OutputFile& file, const program::Program& program) {
  std::string row = "t";
  for (std::size_t fact = 0; fact < program.facts; ++fact) row += "," + header_name(std::string(program.cells[fact].name));
  file.write(row + "\n");
}

void write_facts(trace::OutputFile& file, std::int64_t t_us, std::span<const float> facts) {
  std::string row;
  program::append_seconds(row, t_us);
  for (const float value : facts) {
    row += ',';
    if (value != 0.0f) program::append_number(row, value);
  }
  file.write(row + "\n");
}

/// The line as it was heard, with what was answered to it in a field that `kbc drive` passes over. What is no object stays as it is.
std::string recorded(std::string_view line, const std::string& answer, bool understood) {
  const std::size_t last = line.find_last_not_of(" \t\r");
  const bool again = line.find("\"answered\"") != std::string_view::npos;   // it is played from a recording
  if (!understood || again || last == std::string_view::npos) return std::string(line) + "\n";
  return fmt::format("{},\"answered\":{}}}\n", line.substr(0, last), answer);
}

class Conversation {
 public:
  Conversation(wire::Exchange& exchange, Written& sinks, DriveGround& ground, Session& session)
      : exchange_(exchange), sinks_(sinks), sources_(ground.compiled->sources), messages_(session.diagnostics(sources_)), session_(session),
        channel_(STDIN_FILENO, STDOUT_FILENO, Interrupts::came) {}

  /// Until nobody speaks, nobody listens, or somebody interrupts. Returns the exit code.
  int run() {
    using Came = wire::LineChannel::Came;
    for (std::string line;;) {
      const Came came = channel_.read(line, wire::LineChannel::kForEver);
      if (came == Came::kStopped) return interrupted();
      if (came == Came::kFailed) session_.report(Kind::kCannotRead, {"standard input", source::reason(channel_.error())});
      if (came == Came::kEnd || came == Came::kFailed) return session_.exit_code();
      ++number_;
      const std::string answer = came == Came::kTooLong ? too_long(line) : exchange_.answer(line, number_);
      if (came != Came::kTooLong && exchange_.mistake()) tell(*exchange_.mistake(), line);
      const Came went = channel_.write(answer, wire::LineChannel::kForEver);
      if (went == Came::kStopped) return interrupted();
      if (went == Came::kFailed) session_.report(Kind::kCannotWrite, {"standard output", source::reason(channel_.error())});
      if (went != Came::kLine) return session_.exit_code();
      if (sinks_.record != nullptr) sinks_.record->write(recorded(line, answer, came == Came::kLine && !exchange_.mistake()));
    }
  }

 private:
  std::string too_long(const std::string& line) {
    const wire::Mistake mistake{Kind::kWireLineLong, {fmt::format("{}", wire::kLongestLine), {}, {}}, {}, {source::FileId::kNone, 0, 1}};
    tell(mistake, line);
    return wire::print_answer(mistake, number_);
  }
  void tell(const wire::Mistake& mistake, const std::string& line) {
    if (messages_.errors() > diagnostics::Diagnostics::kMaxErrors) return;   // enough was said, and each costs memory
    wire::report(mistake, trace::excerpt(sources_, "standard input", {line, number_}, mistake.span.begin, mistake.span.end), messages_);
  }
  int interrupted() {
    constexpr int kAtMost_ms = 200;
    wire::LineChannel last(STDIN_FILENO, STDOUT_FILENO, nullptr);
    static_cast<void>(last.write(wire::print_end("interrupted"), kAtMost_ms));
    return 128 + SIGINT;
  }

  wire::Exchange& exchange_;
  Written& sinks_;
  source::Sources& sources_;
  diagnostics::Diagnostics messages_;
  Session& session_;
  wire::LineChannel channel_;
  std::uint64_t number_ = 0;
};

int drive(const DriveCommand& options, DriveGround& ground, const Scene& scene, const wire::ExchangeOptions& how, Session& session) {
  const Interrupts interrupts;
  const wire::NoPipeSignal quiet;
  Written sinks;
  const bool open = open_written(sinks.record, options.record, session) && open_written(sinks.facts, options.facts, session) && open_written(sinks.trace, options.trace, session);
  if (!open) return kErrors;
  const program::Program& program = ground.compiled->program;
  if (sinks.facts != nullptr) write_facts_header(*sinks.facts, program);
  wire::ExchangeOptions told = how;
  told.on_tick = [&](std::int64_t t_us, const program::Tick& tick, std::span<const float> facts) {
    if (sinks.facts != nullptr) write_facts(*sinks.facts, t_us, facts);
    if (sinks.trace != nullptr) sinks.trace->write(print_json(program, tick) + "\n");
  };
  wire::Exchange exchange(*ground.knowledge, *scene.labyrinth, scene.scenario, told);
  const int code = Conversation(exchange, sinks, ground, session).run();
  const bool written = commit(sinks.record, options.record, session) && commit(sinks.facts, options.facts, session) && commit(sinks.trace, options.trace, session);
  return written ? code : kErrors;
}

int run(const DriveCommand& options, Session& session) {
  const auto ground = prepare_ground(options.ground, session);
  if (!ground) return kErrors;
  auto messages = session.diagnostics(ground->compiled->sources);
  const auto set = one_setting(options.ground.set, session);
  if (!set) return kErrors;
  const auto scene = ground->robot(options.robot, *set, session, messages);
  if (!scene) return kErrors;
  wire::ExchangeOptions how;
  how.dt_us = ground->dt_us;
  how.pause_us = *trace::parse_duration(options.pause);
  if (!options.describe) return drive(options, *ground, *scene, how, session);
  session.print(wire::describe(*ground->knowledge, *scene->labyrinth, scene->scenario, how));
  return session.exit_code();
}

}  // namespace

Run setup_drive(CLI::App& app) {
  auto options = std::make_shared<DriveCommand>();
  add_ground_options(app, options->ground);
  app.add_option("--robot", options->robot,
                 "How the robot is built, TOML: [robot], [sensors.range] and [[crossing]] as a scenario has them; a scenario will do, what else it says is passed over")
      ->type_name("FILE");
  app.add_option("--pause", options->pause, "After a longer pause between two lines the robot stands until a button is pressed (500ms)")->type_name("TIME")->check(is_duration());
  auto* record = app.add_option("--record", options->record, "Write what was heard and answered to this file: `kbc drive` reads it again")->type_name("FILE");
  auto* facts = app.add_option("--facts", options->facts, "Write what the mind was told to this file, as `kbc run --facts` reads it")->type_name("FILE");
  auto* trace = app.add_option("--trace", options->trace, "Write the trace to this file, JSON lines")->type_name("FILE");
  auto* describe = app.add_flag("--describe", options->describe, "Print what a host can know before it drives, JSON: fields, facts, buttons, landmarks, the robot");
  for (CLI::Option* file : {record, facts, trace}) {
    file->excludes(describe)->check([](const std::string& path) { return path == "-" ? std::string("standard output is for the answers; name a file") : std::string(); });
  }
  return [options](Session& session) { return run(*options, session); };
}

}  // namespace kb::cli
