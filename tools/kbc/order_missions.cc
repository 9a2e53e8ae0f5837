#include "tools/kbc/order_missions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "compiler/diagnostics/consumers.h"
#include "compiler/model/known_names.h"
#include "compiler/source/numbers.h"

namespace kb::cli {

using diagnostics::Kind;

namespace {

/// `wanted`, or `wanted` with a number appended, so that nothing else has the name.
std::string free_name(const std::string& wanted, const std::set<std::string, std::less<>>& taken) {
  std::string name = wanted;
  for (int i = 2; taken.contains(name); ++i) name = fmt::format("{}{}", wanted, i);
  return name;
}

/// Whether std.retreat, or something equivalent, is imported: the robot turns round while `Round` is high, and `Turned` ends it.
bool turns_round(const std::vector<model::KnownName>& names) {
  const auto knows = [&](std::string_view kind, std::string_view name) {
    return std::any_of(names.begin(), names.end(), [&](const model::KnownName& known) { return known.kind == kind && known.name == name; });
  };
  return knows("strategy", "Round") && knows("fact", "Turned") && knows("level", "route");
}

/// The visit at which the route begins: the second one if the robot is beyond the first, else the first.
std::size_t first_visit(vda5050::Start start) { return start == vda5050::Start::kBeyond ? 1 : 0; }

}  // namespace

std::optional<OrderMissions> OrderMissions::open(const std::string& path, std::vector<std::string> stub, Session& session) {
  const auto plant = session.compile(path, driver::Stage::kModel);
  if (!plant->ok()) return std::nullopt;
  OrderMissions missions(path, std::move(stub), session);
  std::set<std::string, std::less<>> taken;
  const std::vector<model::KnownName> names = model::known_names(plant->model);
  for (const model::KnownName& known : names) taken.emplace(known.name);
  missions.route_ = free_name("Order", taken);
  missions.command_ = free_name("Order_begins", taken);
  if (turns_round(names)) missions.turn_command_ = free_name("Order_turns", taken);
  for (const model::Map& map : plant->model.maps) {
    for (const model::RowId row : map.landmarks) {
      const std::string name(plant->model[row].name);
      if (missions.first_.empty()) missions.first_ = name;
      missions.map_of_.emplace(name, map.name);
    }
  }
  if (!missions.first_.empty()) return missions;
  session.report(Kind::kOrdersNoMap, {path});
  return std::nullopt;
}

std::unique_ptr<driver::Compilation> OrderMissions::compiled(std::span<const vda5050::Visit> way, std::size_t first_leg) const {
  const auto map = map_of_.find(way.front().landmark);
  std::string text = files_->read(path_).bytes.value_or("");
  fmt::format_to(std::back_inserter(text), "\ncommand {}\nroute {} on {} by {}:", command_, route_, map != map_of_.end() ? map->second : std::string(), command_);
  for (const vda5050::Visit& visit : way) {
    fmt::format_to(std::back_inserter(text), "{} {}", &visit == &way.front() ? "" : " ->", visit.landmark);
    if (!visit.exit.empty() && &visit != &way.back()) fmt::format_to(std::back_inserter(text), ".{}", visit.exit);
  }
  text += '\n';
  if (!turn_command_.empty()) text += fmt::format("fact {0}\nrule {0} at route when event {0} and {1} then +sat Round\n", turn_command_, route_);
  return session_->compile_text(path_, text, *files_, first_leg);
}

std::unique_ptr<driver::Compilation> OrderMissions::idle() const {
  const vda5050::Visit anywhere{first_};
  return compiled({&anywhere, 1});
}

std::unique_ptr<tables::LoadedImage> OrderMissions::image_of(const driver::Compilation& compiled) const {
  const std::string bytes = session_->make_image(compiled);
  return bytes.empty() ? nullptr : std::make_unique<tables::LoadedImage>(bytes);
}

std::unique_ptr<OrderMission> OrderMissions::make(const vda5050::Task& task) const {
  auto mission = std::make_unique<OrderMission>();
  const std::size_t before = first_visit(task.start), first = std::max(task.passed, before);   // the visit with which the route begins
  mission->compiled = compiled(std::span(task.way).subspan(first - task.passed), first - before);
  if (!mission->compiled->ok()) return nullptr;
  const driver::Compilation& made = *mission->compiled;
  std::string said;
  diagnostics::ErrorLines lines(made.sources, said);   // not reported to the session, which would keep messages for each of thousands of orders
  diagnostics::Diagnostics messages(made.sources, lines);
  auto knowledge = sim::prepare(made.model, made.program, made.tables, messages, nullptr, &stub_);
  mission->image = image_of(made);
  if (!knowledge) session_->announce(said);
  if (!knowledge || mission->image == nullptr) return nullptr;
  mission->knowledge = std::move(*knowledge);
  mission->knowledge.image = mission->image.get();
  for (const vda5050::Visit& visit : task.way) {
    if (visit.limit_m_s > 0.0) mission->knowledge.limits.add({visit.landmark, visit.exit}, static_cast<float>(visit.limit_m_s));
  }
  return mission;
}

std::optional<std::size_t> OrderMissions::visit_of(std::string_view leg, vda5050::Start start) const {
  const std::size_t begin = route_.size() + 1;
  std::size_t visit = 0;
  if (leg.size() <= begin || !leg.starts_with(route_) || leg[begin - 1] != '.') return std::nullopt;
  const std::size_t colon = leg.find(':', begin);
  if (colon == std::string_view::npos || !source::read_number(leg.substr(begin, colon - begin), visit)) return std::nullopt;
  return visit + first_visit(start);
}

}  // namespace kb::cli
