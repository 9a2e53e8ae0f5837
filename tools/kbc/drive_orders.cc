#include "tools/kbc/drive_orders.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <set>
#include <utility>

#include "sim/world/geometry.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/layout_file.h"
#include "tools/kbc/layout_plant.h"
#include "tools/kbc/vda5050/link/broker_url.h"
#include "tools/kbc/vda5050/link/script_link.h"
#include "tools/kbc/vda5050/read_order.h"
#include "tools/kbc/vda5050/vehicle.h"

namespace kb::cli {

using diagnostics::Kind;

namespace {

vda5050::Skill skill_of(const std::string& text) {
  const std::size_t at = text.find('=');
  vda5050::Skill skill{text.substr(0, at)};
  if (at != std::string::npos) skill.takes_s = static_cast<double>(*trace::parse_duration(text.substr(at + 1))) / 1e6;
  return skill;
}

/// For CLI11: why `text` is not a skill; empty if it is one.
std::string skill_fault(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == 0 || text.empty()) return "an action has a name: `pick`, or `wait=5s`";
  if (at != std::string::npos && !trace::parse_duration(text.substr(at + 1))) return "`" + text.substr(at + 1) + "` is no time; write `wait=5s`";
  return {};
}

/// For CLI11: why `text` is not an interval; empty if it is one.
std::string interval_fault(const std::string& text) {
  return text == "0" || trace::parse_duration(text) ? "" : "`" + text + "` is no time; write `500ms`, or 0 for never";
}

double visualization_s(const OrderOptions& options) {
  if (options.visualization.empty()) return vda5050::is_url(options.link.orders) ? 1.0 : 0.0;
  const auto us = trace::parse_duration(options.visualization);
  return us ? static_cast<double>(*us) / 1e6 : 0.0;
}

vda5050::Sheet sheet_of(const sim::Scenario& robot) {
  vda5050::Sheet sheet;
  sheet.speed_max_m_s = robot.drive.speed_m_s;
  sheet.acceleration_m_s2 = sheet.deceleration_m_s2 = robot.drive.acceleration_m_s2;
  sheet.width_m = sheet.length_m = 2.0 * static_cast<double>(robot.body.radius_m);
  return sheet;
}

/// For CLI11: why `text` does not name the file of a layout; empty if it does.
std::string layout_fault(const std::string& text) {
  const std::size_t at = text.find(':');
  const bool good = at != std::string::npos && at + 1 < text.size() && layout_format(text.substr(0, at)) != nullptr;
  return good ? "" : "`" + text + "` does not say what the file is written in; write `lif:yard.json`, `nav2:FILE` or `opentcs:FILE`";
}

/// The nodes and edges of orders. Null (reported) if the layout is not that of the knowledge base.
std::unique_ptr<vda5050::Plant> plant_of(const OrderOptions& options, const OrderMissions& missions, const DriveGround& ground, const sim::Labyrinth& floor, Session& session) {
  const std::vector<model::Map>& maps = ground.compiled->model.maps;
  const bool turns = !missions.turn_command().empty();
  if (options.imported_from.empty()) {
    return std::make_unique<RoadPlant>(floor, options.map.empty() ? maps.front().name : options.map, turns, options.prefix);
  }
  source::Sources& sources = ground.compiled->sources;
  const std::size_t at = options.imported_from.find(':');
  const auto file = session.open(options.imported_from.substr(at + 1), sources);
  if (!file) return nullptr;
  auto messages = session.diagnostics(sources);
  LayoutImport how{options.imported_from.substr(0, at), options.choice, {}};
  how.wording.map.clear();   // the map is one of the knowledge base's
  how.wording.prefix = options.prefix;
  how.wording.taken = [&](std::string_view name) {
    return std::any_of(maps.begin(), maps.end(), [&](const model::Map& map) { return map.name == name; });
  };
  layout::Adaptations told_by_import;
  auto map = read_layout(how, sources, *file, told_by_import, messages, session);
  if (!map) return nullptr;
  std::string map_id = options.map.empty() ? map_of(map->layout) : options.map;
  if (map_id.empty()) map_id = maps.front().name;
  auto plant = std::make_unique<LayoutPlant>(std::move(*map), floor, std::move(map_id), turns, options.prefix);
  return plant->is_on_floor(messages) ? std::move(plant) : nullptr;
}

/// A master knows the plant in metres, and would be told others.
void warn_of_scale(const sim::Labyrinth& floor, const DriveGround& ground, Session& session) {
  if (floor.scaled_for == sim::RoadId::kNone) return;
  const sim::Road& road = floor[floor.scaled_for];
  auto messages = session.diagnostics(ground.compiled->sources);
  messages.report(Kind::kOrdersScale, road.span, {road.name, fmt::format("{:.3g}", sim::length_of(road.along) / floor.scale), fmt::format("{:g}", floor.scale)});
}

void add_plant_options(CLI::App& app, OrderOptions& options, CLI::Option* orders, const std::string& group) {
  app.add_option("--map-id", options.map, "The map that positions are on (that of the layout; else the name of the knowledge base's map)")
      ->type_name("NAME")->needs(orders)->group(group);
  auto* from = app.add_option("--imported-from", options.imported_from, "The layout that `kbc import` made the map from: orders name its nodes and edges. lif:FILE, nav2:FILE or opentcs:FILE")
                   ->type_name("LAYOUT")->check(layout_fault)->needs(orders)->group(group);
  app.add_option("--layout", options.choice.layout, "As in the import: of several layouts in a LIF file, this one")
      ->type_name("ID")->needs(from)->group(group);
  app.add_option("--vehicle", options.choice.vehicle, "As in the import: of a LIF file, only what this type of vehicle may use")
      ->type_name("ID")->needs(from)->group(group);
  app.add_option("--prefix", options.prefix, "As in the import: put before an id that cannot be a name, such as 7 (LM)")
      ->type_name("NAME")->check(name_fault)->needs(orders)->group(group);
}

/// Checks options that depend on each other; throws CLI::ValidationError.
void check_together(const CLI::App& app, const OrderOptions& options) {
  for (const char* option : {"--layout", "--vehicle"}) {
    if (app.count(option) > 0 && !options.imported_from.starts_with("lif:")) throw CLI::ValidationError(option, "is only for `lif`");
  }
  std::set<std::string> types;
  for (const std::string& text : options.skills) {
    const std::string type = skill_of(text).type;
    if (std::ranges::find(vda5050::kOwnActions, type) != vda5050::kOwnActions.end()) throw CLI::ValidationError("--skill", "`" + type + "` is an action that every vehicle does by itself");
    if (!types.insert(type).second) throw CLI::ValidationError("--skill", "`" + type + "` is given twice");
  }
}

}  // namespace

void add_order_options(CLI::App& app, OrderOptions& options, std::string& messages) {
  const std::string group = "Orders of a fleet's master (VDA 5050)";
  auto* orders = app.add_option("--orders", options.link.orders, "The source of missions: mqtt://HOST[:PORT], mqtts://..., or a file of messages, JSON lines")
                     ->type_name("URL|FILE")->group(group);
  app.add_option("--manufacturer", options.link.identity.manufacturer, "The vehicle's manufacturer, as the master names it (Waymark)")->type_name("NAME")->needs(orders)->group(group);
  app.add_option("--serial", options.link.identity.serial, "The vehicle's number, as the master calls it (1)")->type_name("NAME")->needs(orders)->group(group);
  app.add_option("--interface", options.link.interface_name, "What topics begin with (uagv)")->type_name("NAME")->needs(orders)->group(group);
  app.add_option("--ca", options.link.ca_file, "The certificate authority (PEM) of the broker, for mqtts://")->type_name("FILE")->needs(orders)->group(group);
  app.add_option("--skill", options.skills, "An action that the robot can do: `pick`, which the host does and reports, or `wait=5s`, which ends by itself; several with commas, or repeat the option")
      ->type_name("ACTION")->allow_extra_args(false)->delimiter(',')->check(skill_fault)->needs(orders)->group(group);
  app.add_option("--visualization", options.visualization, "How often to send the position, besides states: 500ms; 0: never (1s with a broker, never with a file)")
      ->type_name("TIME")->needs(orders)->check(interval_fault)->group(group);
  app.add_option("--messages", messages, "Write the messages between master and vehicle to this file; --orders can read it")->type_name("FILE")->needs(orders)->group(group);
  add_plant_options(app, options, orders, group);
  app.callback([&app, &options] { check_together(app, options); });
}

std::unique_ptr<Orders> Orders::open(const OrderOptions& options, const OrderMissions& missions, const DriveGround& ground, const Scene& scene,
                                     wire::Exchange& exchange, trace::OutputFile* messages, Session& session) {
  std::unique_ptr<Orders> orders(new Orders(vda5050::without_password(options.link.orders), session));
  orders->plant_ = plant_of(options, missions, ground, *scene.labyrinth, session);
  if (orders->plant_ == nullptr) return nullptr;
  warn_of_scale(*scene.labyrinth, ground, session);
  std::vector<vda5050::Skill> skills;
  for (const std::string& text : options.skills) skills.push_back(skill_of(text));
  vda5050::Sheet sheet = sheet_of(scene.scenario);
  sheet.visualization_s = visualization_s(options);
  orders->vehicle_.emplace(options.link.identity, std::move(skills), *orders->plant_, std::move(sheet));
  auto diagnostics = session.diagnostics(ground.compiled->sources);
  vda5050::LinkOptions how = options.link;
  vda5050::take_credentials(how);
  how.prepare = [who = how.identity](vda5050::Message& message) { message.read = std::make_shared<vda5050::ReadMessage>(vda5050::read_message(message, who)); };
  how.will = [who = how.identity](std::uint32_t header_id, std::int64_t utc_us) { return vda5050::will_of(who, header_id, utc_us); };
  orders->link_ = vda5050::make_link(how, session.files(), ground.compiled->sources, diagnostics);
  if (orders->link_ == nullptr) return nullptr;
  if (messages != nullptr) orders->link_ = std::make_unique<vda5050::Recorder>(std::move(orders->link_), *messages);
  orders->desk_.emplace(missions, *ground.knowledge, exchange, *orders->vehicle_, *orders->link_);
  return orders;
}

void Orders::tell() {
  for (std::string news = link_->news(); !news.empty(); news = link_->news()) session_.remark(from_ + ": " + news);
}

}  // namespace kb::cli
