#include "tools/kbc/order_missions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "compiler/diagnostics/consumers.h"
#include "compiler/model/known_names.h"

namespace kb::cli {

using diagnostics::Kind;

namespace {

/// `wanted`, or with a number behind it, so that nothing has that name.
std::string free_name(const std::string& wanted, const std::set<std::string, std::less<>>& taken) {
  std::string name = wanted;
  for (int i = 2; taken.contains(name); ++i) name = fmt::format("{}{}", wanted, i);
  return name;
}

}  // namespace

std::optional<OrderMissions> OrderMissions::open(const std::string& path, std::vector<std::string> stub, Session& session) {
  const auto plant = session.compile(path, driver::Stage::kModel);
  if (!plant->ok()) return std::nullopt;
  OrderMissions missions(path, std::move(stub), session);
  std::set<std::string, std::less<>> taken;
  for (const model::KnownName& known : model::known_names(plant->model)) taken.emplace(known.name);
  missions.route_ = free_name("Order", taken);
  missions.command_ = free_name("Order_begins", taken);
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

std::unique_ptr<driver::Compilation> OrderMissions::compiled(std::span<const vda5050::Visit> way) const {
  const auto map = map_of_.find(way.front().landmark);
  std::string text = fmt::format("import \"{}\"\ncommand {}\nroute {} on {} by {}:", std::filesystem::path(path_).filename().string(), command_, route_,
                                map != map_of_.end() ? map->second : std::string(), command_);
  for (const vda5050::Visit& visit : way) {
    fmt::format_to(std::back_inserter(text), "{} {}", &visit == &way.front() ? "" : " ->", visit.landmark);
    if (!visit.exit.empty() && &visit != &way.back()) fmt::format_to(std::back_inserter(text), ".{}", visit.exit);
  }
  text += '\n';
  return session_->compile_text((std::filesystem::path(path_).parent_path() / "order.kb").generic_string(), text, *files_);
}

std::unique_ptr<driver::Compilation> OrderMissions::idle() const {
  const vda5050::Visit anywhere{first_};
  return compiled({&anywhere, 1});
}

std::unique_ptr<tables::LoadedImage> OrderMissions::image_of(const driver::Compilation& compiled) const {
  const std::string bytes = session_->make_image(compiled);
  return bytes.empty() ? nullptr : std::make_unique<tables::LoadedImage>(bytes);
}

std::unique_ptr<OrderMission> OrderMissions::make(std::span<const vda5050::Visit> way) const {
  auto mission = std::make_unique<OrderMission>();
  mission->compiled = compiled(way);
  if (!mission->compiled->ok()) return nullptr;
  const driver::Compilation& made = *mission->compiled;
  std::string said;
  diagnostics::ErrorLines lines(made.sources, said);   // not the session's: it would keep them for each of thousands of orders
  diagnostics::Diagnostics messages(made.sources, lines);
  auto knowledge = sim::prepare(made.model, made.program, made.tables, messages, nullptr, &stub_);
  mission->image = image_of(made);
  if (!knowledge) session_->announce(said);
  if (!knowledge || mission->image == nullptr) return nullptr;
  mission->knowledge = std::move(*knowledge);
  mission->knowledge.image = mission->image.get();
  return mission;
}

std::optional<std::size_t> OrderMissions::visit_of(std::string_view leg) const {
  const std::size_t begin = route_.size() + 1;
  std::size_t visit = 0;
  if (leg.size() <= begin || !leg.starts_with(route_) || leg[begin - 1] != '.') return std::nullopt;
  const auto read = std::from_chars(leg.data() + begin, leg.data() + leg.size(), visit);
  if (read.ec != std::errc() || read.ptr == leg.data() + leg.size() || *read.ptr != ':') return std::nullopt;
  return visit;
}

}  // namespace kb::cli
