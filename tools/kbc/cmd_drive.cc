// kbc drive: a knowledge base drives a user's robot, over standard input and output.
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "compiler/source/reason.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/drive_ground.h"
#include "tools/kbc/drive_log.h"
#include "tools/kbc/drive_orders.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/named_files.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/wire/describe.h"
#include "tools/kbc/wire/exchange.h"
#include "tools/kbc/wire/fields.h"
#include "tools/kbc/wire/line_channel.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct DriveCommand {
  GroundOptions ground;
  std::string robot;
  DriveLog::Names log;
  OrderOptions orders;
  std::string pause = "500ms";
  bool describe = false;
};

class Conversation {
 public:
  /// `orders` may be null.
  Conversation(wire::Exchange& exchange, DriveLog& log, Orders* orders, DriveGround& ground, Session& session)
      : exchange_(exchange), log_(log), orders_(orders), sources_(ground.compiled->sources), session_(session),
        channel_(STDIN_FILENO, STDOUT_FILENO, Interrupts::came) {}

  /// Runs until the input ends, nobody reads the output, or an interrupt comes. Returns the exit code.
  int run() {
    using Came = wire::LineChannel::Came;
    for (std::string line;;) {
      const Came came = channel_.read(line, waits_ms());
      if (Interrupts::reopen()) log_.reopen();
      if (came == Came::kLate) {
        orders_->wait(unheard_us());
        log_.keep();
        continue;
      }
      if (came == Came::kStopped) return interrupted();
      if (came == Came::kFailed) session_.report(Kind::kCannotRead, {"standard input", source::reason(channel_.error())});
      if (came == Came::kEnd || came == Came::kFailed) return session_.exit_code();
      ++number_;
      if (came == Came::kLine && line.find_first_not_of(" \t\r") == std::string::npos) {   // nobody has said anything
        if (orders_ != nullptr) follow_orders(false);
        log_.heard(line, {}, false);
        continue;
      }
      const std::string answer = exchange_.answer(line, number_);
      for (const auto* said : {&exchange_.mistake(), &exchange_.warning()}) {
        if (*said) tell(**said, line);
      }
      const Came went = give(answer);
      if (went == Came::kStopped) return interrupted();
      if (went == Came::kFailed) session_.report(Kind::kCannotWrite, {"standard output", source::reason(channel_.error())});
      if (went != Came::kLine) return session_.exit_code();
      if (orders_ != nullptr) follow_orders(exchange_.line().has_value());
      log_.heard(line, answer, !exchange_.mistake());
    }
  }

 private:
  static constexpr int kListens_ms = 100;   // how long it waits for the master's messages while the robot sends or takes nothing

  /// How long it waits for the robot before it looks after the master.
  [[nodiscard]] int waits_ms() const { return orders_ != nullptr && orders_->live() ? kListens_ms : wire::LineChannel::kForEver; }
  /// How long nothing has come that could be understood: by this machine's clock, or, with orders from a file, which give the same each time, as if each
  /// other line came as long after the one before as the last that was understood.
  [[nodiscard]] std::int64_t unheard_us() const {
    if (!orders_->live()) return unheard_ * std::max(sim::kControlUs, static_cast<std::int64_t>(static_cast<double>(exchange_.period_s()) * 1e6));
    return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - heard_at_).count();
  }
  /// A robot whose lines are refused stands, like one that is silent.
  void follow_orders(bool heard) {
    if (heard) heard_at_ = std::chrono::steady_clock::now();
    unheard_ = heard ? 0 : unheard_ + 1;
    if (heard) orders_->step();
    else orders_->wait(unheard_us());
  }
  /// Gives the robot an answer, however long it takes none.
  wire::LineChannel::Came give(const std::string& answer) {
    using Came = wire::LineChannel::Came;
    std::int64_t stuck_us = 0;
    Came went = channel_.write(answer, waits_ms());
    for (; went == Came::kLate; went = channel_.write_on(waits_ms())) orders_->wait(stuck_us += kListens_ms * 1000);
    return went;
  }
  /// Each kind of message has a limit of its own: what has gone wrong for weeks must not hide what begins to go wrong.
  void tell(const wire::Mistake& mistake, const std::string& line) {
    diagnostics::Diagnostics& messages = messages_.try_emplace(mistake.kind, session_.diagnostics(sources_)).first->second;
    if (messages.errors() + messages.warnings() > diagnostics::Diagnostics::kMaxErrors) return;   // there are messages enough, and each costs memory
    wire::report(mistake, trace::excerpt(sources_, "standard input", {line, number_}, mistake.span.begin, mistake.span.end), messages);
  }
  int interrupted() {
    constexpr int kAtMost_ms = 200;
    wire::LineChannel last(STDIN_FILENO, STDOUT_FILENO, nullptr);
    static_cast<void>(last.write(wire::print_end("interrupted"), kAtMost_ms));
    return kInterrupted;
  }

  wire::Exchange& exchange_;
  DriveLog& log_;
  Orders* orders_;
  source::Sources& sources_;
  std::map<Kind, diagnostics::Diagnostics> messages_;
  Session& session_;
  wire::LineChannel channel_;
  std::uint64_t number_ = 0;
  std::chrono::steady_clock::time_point heard_at_ = std::chrono::steady_clock::now();
  std::int64_t unheard_ = 0;   // lines in a row
};

/// `missions`: those of orders; null if the knowledge base has its own missions.
int drive(const DriveCommand& options, const OrderMissions* missions, DriveGround& ground, const Scene& scene, wire::ExchangeOptions how, Session& session) {
  const Interrupts interrupts(true);
  const wire::NoPipeSignal quiet;
  DriveLog log(options.log, ground.compiled->program, session);
  if (!log.open(options.ground.file)) return kErrors;
  how.on_tick = [&](const program::Tick& tick, std::string_view json, std::span<const float> facts) { log.ticked(tick, json, facts); };
  std::unique_ptr<tables::LoadedImage> image;
  if (missions != nullptr) {
    image = missions->image_of(*ground.compiled);
    if (image == nullptr) return kErrors;
    ground.knowledge->image = image.get();
  }
  wire::Exchange exchange(*ground.knowledge, *scene.labyrinth, scene.scenario, std::move(how));
  std::unique_ptr<Orders> orders;
  if (missions != nullptr) {
    orders = Orders::open(options.orders, *missions, ground, scene, exchange, log.messages(), session);
    if (orders == nullptr) return kErrors;
  }
  const int code = Conversation(exchange, log, orders.get(), ground, session).run();
  if (orders != nullptr) orders->end();
  return log.end() ? code : kErrors;
}

int run(const DriveCommand& options, Session& session) {
  std::optional<OrderMissions> missions;
  if (options.orders.given() && !(missions = OrderMissions::open(options.ground.file, options.ground.stub, session))) return kErrors;
  const auto ground = missions ? prepare_ground(options.ground, missions->idle(), session) : prepare_ground(options.ground, session);
  if (!ground) return kErrors;
  auto messages = session.diagnostics(ground->compiled->sources);
  const auto set = one_setting(options.ground.set, session);
  if (!set) return kErrors;
  const auto scene = ground->robot(options.robot, *set, session, messages);
  if (!scene) return kErrors;
  wire::ExchangeOptions how;
  how.dt_us = ground->dt_us;
  how.pause_us = *trace::parse_duration(options.pause);
  how.has_master = missions.has_value();
  if (!options.describe) return drive(options, missions ? &*missions : nullptr, *ground, *scene, std::move(how), session);
  session.print(wire::describe(*ground->knowledge, *scene->labyrinth, scene->scenario, how));
  return session.exit_code();
}

}  // namespace

Run setup_drive(CLI::App& app) {
  auto options = std::make_shared<DriveCommand>();
  add_ground_options(app, options->ground);
  app.add_option("--robot", options->robot,
                 "How the robot is built, TOML: [robot], [sensors.range] and [[crossing]] as in a scenario; all else in a scenario is ignored")
      ->type_name("FILE");
  app.add_option("--pause", options->pause, "After a longer pause between two lines the robot stands until a button is pressed (500ms)")->type_name("TIME")->check(is_duration());
  auto* record = app.add_option("--record", options->log.record, "Write what was heard and answered to this file: `kbc drive` reads it again")->type_name("FILE");
  auto* facts = app.add_option("--facts", options->log.facts, "Write what the mind was told to this file, as `kbc run --facts` reads it")->type_name("FILE");
  auto* trace = app.add_option("--trace", options->log.trace, "Write the trace to this file, JSON lines")->type_name("FILE");
  auto* describe = app.add_flag("--describe", options->describe, "Print what a host can know before it drives, JSON: fields, facts, buttons, landmarks, the robot");
  for (CLI::Option* file : {record, facts, trace}) {
    file->excludes(describe)->check([](const std::string& path) { return is_standard_output(path) ? std::string("standard output is for the answers; name a file") : std::string(); });
  }
  add_order_options(app, options->orders, options->log.messages);
  app.get_option("--orders")->excludes(describe);
  app.parse_complete_callback([options, facts] {
    if (options->orders.given() && !facts->empty()) throw CLI::ValidationError("--facts", "with --orders each order makes other rules, which no recording of facts can tell; use --record and --messages, and --trace");
  });
  return [options](Session& session) {
    Interrupts::put_off_hangups();
    return run(*options, session);
  };
}

}  // namespace kb::cli
