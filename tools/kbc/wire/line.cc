#include "tools/kbc/wire/line.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "compiler/program/text.h"
#include "compiler/source/utf8.h"
#include "sim/world/geometry.h"
#include "tools/kbc/wire/fields.h"

namespace kb::wire {
namespace {

using program::append_json;
using program::append_number;

constexpr double kLatest = 1e11;                 // s: some 3,000 years
constexpr float kFullTurn = 6.283186f;           // rad
constexpr Range kDark{-0.5, 1.5};                // a sensor may be slightly out of range
constexpr Range kRow{-1.0, 1.0};                 // m: a host that sends millimetres gets a message
constexpr Range kOdometry{-1e9, 1e9}, kRanges{-1e6, 1000.0}, kSpeeds{-100.0, 100.0}, kAngles{-1e6, 1e6}, kCertainties{-1.0, 1.0}, kMeasured{-1e30, 1e30};

/// Which fields of those that belong together a line has, while it is read.
struct Draft {
  Line line;
  double t_s = 0.0;
  bool t = false, x = false, y = false;
};

void read_names(Reading& reading, std::string_view field, const Json& json, std::vector<Name>& names) {
  std::vector<std::string> texts;
  reading.texts(field, json, texts);
  for (std::size_t i = 0; i < texts.size(); ++i) names.push_back({std::move(texts[i]), json.parts[i].span});
}

constexpr std::array kTagFields{
    Field<Tag>{"landmark", [](Reading& reading, const Json& json, Tag& tag) { reading.text("tag.landmark", json, tag.landmark.text), tag.landmark.at = json.span; }},
    Field<Tag>{"exit", [](Reading& reading, const Json& json, Tag& tag) { reading.text("tag.exit", json, tag.exit.text), tag.exit.at = json.span; }},
    Field<Tag>{"safe", [](Reading& reading, const Json& json, Tag& tag) { reading.truth("tag.safe", json, tag.safe); }},
    Field<Tag>{"closed", [](Reading& reading, const Json& json, Tag& tag) { read_names(reading, "tag.closed", json, tag.closed); }},
};

void read_tag(Reading& reading, const Json& json, Draft& draft) {
  if (!reading.is("tag", json, Json::Kind::kObject)) return;
  draft.line.reader = true;
  if (json.keys.empty()) return;   // the floor is not read
  Tag tag;
  read_fields<Tag>(reading, "tag.", json, kTagFields, tag);
  if (tag.landmark.text.empty()) reading.missing("tag.landmark", "a tag that is read says at which landmark it lies; `{}` says that none is read", json.span);
  if (tag.exit.text.empty()) reading.missing("tag.exit", "a tag says on the road of which exit of its landmark it lies", json.span);
  draft.line.tag = std::move(tag);
}

constexpr std::array kGuideFields{
    Field<Guide>{"left_m", [](Reading& reading, const Json& json, Guide& guide) { reading.number("line.left_m", json, kRow, guide.left_m.emplace()); }},
    Field<Guide>{"across", [](Reading& reading, const Json& json, Guide& guide) { reading.truth("line.across", json, guide.across); }},
};

/// Up to a full turn as it is said, to the last bit; the compass of some robots counts on beyond that.
void read_compass(Reading& reading, const Json& json, Line& line) {
  float& heading_rad = line.senses.heading_rad;
  reading.number("compass_rad", json, kAngles, heading_rad);
  line.senses.heading_known = true;
  line.compass_at = json.span;
  if (std::abs(heading_rad) <= kFullTurn) return;
  line.turns_rad = heading_rad;
  heading_rad = static_cast<float>(std::remainder(static_cast<double>(heading_rad), 2.0 * sim::kPi));
}

/// Five darknesses, or the readings of a sensor that measures where the line is.
void read_floor(Reading& reading, const Json& json, Draft& draft) {
  if (json.kind == Json::Kind::kObject) return read_fields<Guide>(reading, "line.", json, kGuideFields, draft.line.guide.emplace());
  reading.numbers("line", json, kDark, draft.line.senses.line);
  draft.line.senses.line_known = true;
}

void read_facts(Reading& reading, const Json& json, Draft& draft) {
  if (!reading.is("facts", json, Json::Kind::kObject)) return;
  reading.once("facts.", json);
  for (std::size_t i = 0; i < json.keys.size(); ++i) {
    Line::Said said{{json.keys[i], json.parts[i].span}, std::nullopt};
    float value = 0.0f;
    if (json.parts[i].kind != Json::Kind::kNull) reading.number("facts." + source::printable(json.keys[i]), json.parts[i], kCertainties, value), said.value = value;
    draft.line.facts.push_back(std::move(said));
  }
}

void read_value(Reading& reading, const std::string& field, const Json& json, std::vector<Line::Value>& values) {
  float value = 0.0f;
  if (json.kind == Json::Kind::kNull) return void(values.emplace_back());
  if (json.kind == Json::Kind::kString) return void(values.emplace_back(json.text));
  if (json.kind != Json::Kind::kNumber) return reading.unwanted(field, json, "a number or a string");
  reading.number(field, json, kMeasured, value);
  values.emplace_back(value);
}

void read_readings(Reading& reading, const Json& json, Draft& draft) {
  if (!reading.is("readings", json, Json::Kind::kObject)) return;
  reading.once("readings.", json);
  for (std::size_t i = 0; i < json.keys.size(); ++i) {
    const Json& part = json.parts[i];
    const std::string field = "readings." + source::printable(json.keys[i]);
    Line::Measured& measured = draft.line.readings.emplace_back(Line::Measured{{json.keys[i], part.span}, {}, part.kind == Json::Kind::kList});
    if (!measured.list) read_value(reading, field, part, measured.values);
    else for (const Json& one : part.parts) read_value(reading, fmt::format("{}[{}]", field, measured.values.size()), one, measured.values);
  }
}

constexpr std::array kFields{
    Field<Draft>{"t", [](Reading& reading, const Json& json, Draft& draft) {
      reading.number("t", json, {0.0, kLatest}, draft.t_s);
      draft.t = true;
      draft.line.t_at = json.span;
    }, "s", "0 and more, of any zero; it grows from line to line. Must be there, all else need not"},
    Field<Draft>{"line", read_floor,
      "0 bright to 1 dark", "5 floor sensors in a row across the front, the first at the left; or an object, of a sensor that measures the line: left_m, if there is one, in m to the left, and across: true on paint that lies across"},
    Field<Draft>{"range_m", [](Reading& reading, const Json& json, Draft& draft) {
      reading.numbers("range_m", json, kRanges, draft.line.senses.range_m);
      draft.line.senses.range_known = true;
    }, "m", "8 range finders, every 45 degrees counter-clockwise, the first ahead: from the robot's centre; 4 (times the robot's size) and more: nothing is there; null: unknown"},
    Field<Draft>{"compass_rad", [](Reading& reading, const Json& json, Draft& draft) {
      read_compass(reading, json, draft.line);
    }, "rad", "counter-clockwise from east; whole turns do not matter"},
    Field<Draft>{"odometry_x_m", [](Reading& reading, const Json& json, Draft& draft) {
      reading.number("odometry_x_m", json, kOdometry, draft.line.x_m);
      draft.x = true;
    }, "m", "east by the wheels, of any zero"},
    Field<Draft>{"odometry_y_m", [](Reading& reading, const Json& json, Draft& draft) {
      reading.number("odometry_y_m", json, kOdometry, draft.line.y_m);
      draft.y = true;
    }, "m", "north by the wheels, of any zero"},
    Field<Draft>{"odometry_m_s", [](Reading& reading, const Json& json, Draft& draft) {
      reading.number("odometry_m_s", json, kSpeeds, draft.line.senses.speed_m_s);
      draft.line.senses.odometry_known = true;
    }, "m/s", "by the wheels, backwards negative"},
    Field<Draft>{"odometry_turned_rad", [](Reading& reading, const Json& json, Draft& draft) {
      reading.number("odometry_turned_rad", json, kOdometry, draft.line.turned_rad);
      draft.line.senses.turned_known = true;
    }, "rad", "by the wheels or a gyroscope, counter-clockwise, of any zero"},
    Field<Draft>{"touched", [](Reading& reading, const Json& json, Draft& draft) { reading.truth("touched", json, draft.line.senses.touched); },
      "true or false", "the bumper"},
    Field<Draft>{"tag", read_tag,
      "object", "{} while none is read, else landmark and exit; safe: false and closed: [exits] where the crossing or roads are barred"},
    Field<Draft>{"buttons", [](Reading& reading, const Json& json, Draft& draft) { read_names(reading, "buttons", json, draft.line.buttons); },
      "list of names", "those that are pressed; each a fact"},
    Field<Draft>{"facts", read_facts,
      "object", "what the host says itself: names and certainties from -1 to 1; it goes before what is perceived"},
    Field<Draft>{"readings", read_readings,
      "object", "of sensors that only the knowledge base knows: numbers in m, s, m/s, deg, deg/s or without a unit, texts, lists of arrays; null: silent"},
    Field<Draft>{"vehicle", [](Reading& reading, const Json& json, Draft& draft) { draft.line.vehicle_at = json.span; read_vehicle(reading, json, draft.line.vehicle); },
      "object", "of who drives by --orders: battery in percent, charging, field_violation; e_stop: NONE, AUTOACK, MANUAL or REMOTE; mode: AUTOMATIC, SEMIAUTOMATIC, MANUAL, SERVICE or TEACHIN"},
    Field<Draft>{"actions", [](Reading& reading, const Json& json, Draft& draft) { draft.line.actions_at = json.span; read_actions(reading, json, draft.line.actions); },
      "list of objects", "of who drives by --orders: how far an action of the answers is: id, status (running, paused, finished or failed), result"},
    Field<Draft>{"answered", [](Reading&, const Json&, Draft&) {}},   // recordings have it too
};

/// Whether the text is a NaN or infinity as Python and some others write it into JSON.
bool is_no_number(std::string_view text) { return text.starts_with("NaN") || text.starts_with("Infinity"); }

}  // namespace

std::variant<Line, Mistake> read_line(std::string_view text) {
  Reading reading;
  const auto object = reading.object(text);
  Draft draft;
  mts::Senses& senses = draft.line.senses;
  for (float& range_m : senses.range_m) range_m = mts::kOutOfRange;
  if (object) {
    read_fields<Draft>(reading, "", *object, kFields, draft);
    if (!draft.t) reading.missing("t", "each line says its time, in s", object->span);
    if (draft.x != draft.y) reading.missing(draft.x ? "odometry_y_m" : "odometry_x_m", "a place has two coordinates", object->span);
    if (draft.x && !senses.odometry_known) reading.missing("odometry_m_s", "odometry says its speed as well as its place", object->span);
  }
  if (reading.mistake()) {
    Mistake mistake = *reading.mistake();
    if (!object && is_no_number(text.substr(mistake.span.begin))) mistake.better = "null";
    return mistake;
  }
  senses.x_m = static_cast<float>(draft.line.x_m);
  senses.y_m = static_cast<float>(draft.line.y_m);
  senses.turned_rad = static_cast<float>(draft.line.turned_rad);
  if (senses.odometry_known && !draft.x) senses.x_m = senses.y_m = std::numeric_limits<float>::quiet_NaN();   // then the speed is used: see mts::Odometer
  draft.line.t_us = std::llround(draft.t_s * 1e6);
  return std::move(draft.line);
}

Mistake no_such(std::string_view kind, const Name& name, std::string field, std::optional<std::string> better) {
  return {diagnostics::Kind::kWireUnknownName, {std::string(kind), source::printable(name.text), {}}, std::move(field), name.at, std::move(better)};
}

std::vector<FieldHelp> line_fields() {
  std::vector<FieldHelp> help;
  for (const Field<Draft>& field : kFields) {
    if (!field.about.empty()) help.push_back({field.name, field.unit, field.about});
  }
  return help;
}

namespace {

class Printer {
 public:
  explicit Printer(std::string& out) : out_(out) {}
  void number(std::string_view key, float value) {
    program::append_key(out_, key);
    append(value);
  }
  template <std::size_t kCount>
  void numbers(std::string_view key, const float (&values)[kCount], unsigned unknown = 0) {
    program::append_key(out_, key);
    out_ += '[';
    for (std::size_t i = 0; i < kCount; ++i) {
      if (i > 0) out_ += ',';
      if ((unknown >> i & 1u) != 0) out_ += "null";
      else append(values[i]);
    }
    out_ += ']';
  }

 private:
  void append(float value) {
    if (std::isnan(value)) out_ += "null";
    else if (value == 0.0f && std::signbit(value)) out_ += "-0.0";   // `-0` would be read as a whole number, without the sign
    else append_number(out_, value);
  }
  std::string& out_;
};

void append_names(std::string& out, std::string_view key, const std::vector<std::string>& names) {
  program::append_key(out, key);
  program::append_items(out, names, [&](const std::string& name) { append_json(out, name); });
}

void print_tag(std::string& out, const sim::TagHeard& tag) {
  program::append_key(out, "tag");
  out += '{';
  if (tag.memory != nullptr) {
    out += "\"landmark\":";
    append_json(out, tag.memory->landmark);
    program::append_key(out, "exit");
    append_json(out, tag.memory->exits[tag.arm].name);
    if (!tag.memory->safe) out += ",\"safe\":false";
    std::vector<std::string> closed;
    for (const sim::Memory::Exit& exit : tag.memory->exits) {
      if (exit.closed) closed.push_back(exit.name);
    }
    if (!closed.empty()) append_names(out, "closed", closed);
  }
  out += '}';
}

}  // namespace

std::string print_line(std::int64_t t_us, const mts::Senses& senses, const sim::TagHeard& tag, const std::vector<std::string>& buttons) {
  std::string out = "{\"t\":";
  program::append_seconds(out, t_us);
  Printer print(out);
  if (senses.line_known) print.numbers("line", senses.line);
  if (senses.range_known) print.numbers("range_m", senses.range_m, senses.ranges_unknown);
  if (senses.heading_known) print.number("compass_rad", senses.heading_rad);
  if (senses.odometry_known) {
    print.number("odometry_x_m", senses.x_m);
    print.number("odometry_y_m", senses.y_m);
    print.number("odometry_m_s", senses.speed_m_s);
  }
  if (senses.turned_known) print.number("odometry_turned_rad", senses.turned_rad);
  out += senses.touched ? ",\"touched\":true" : ",\"touched\":false";
  if (tag.alive) print_tag(out, tag);
  if (!buttons.empty()) append_names(out, "buttons", buttons);
  return out + "}";
}

std::string with_answer(std::string_view line, std::string_view answer) {
  std::string out(line.substr(0, line.find_last_of('}')));
  if (line.find("\"answered\"") != std::string_view::npos) {
    Reading reading;
    const Json object = reading.object(line).value();   // it has been read successfully before
    const auto place = [&](std::size_t i) { return reading.key_of(object.keys[i], object.parts[i].span).begin; };
    for (std::size_t i = 0; i < object.keys.size(); ++i) {
      if (object.keys[i] != "answered") continue;
      const std::size_t before = out.find_last_of(",{", place(i) - 1);
      if (i + 1 == object.keys.size()) out.erase(before);   // the comma before it: every line also has `t`
      else out.erase(before + 1, out.find_last_of(',', place(i + 1) - 1) - before);
    }
  }
  return out + ",\"answered\":" + std::string(answer) + "}";
}

}  // namespace kb::wire
