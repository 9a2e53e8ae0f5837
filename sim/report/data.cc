#include "sim/report/data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/report/kinds.h"
#include "sim/report/text.h"

namespace kb::sim::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3, kCenti = 1e2, kCertainty = 1e4, kTime = 1e4;

Json integer(double value, double per_unit) {
  if (!std::isfinite(value) || std::abs(value) * per_unit > 1e15) return nullptr;
  return std::llround(value * per_unit);
}

/// Whole numbers, each as the difference from the one before.
class Column {
 public:
  void add(const Json& number) {
    if (number.is_null()) {
      values_.push_back(nullptr);
      return;
    }
    any_ = true;
    const auto value = number.get<std::int64_t>();
    values_.push_back(value - last_);
    last_ = value;
  }
  [[nodiscard]] Json take() { return any_ ? std::move(values_) : Json::array(); }

 private:
  Json values_ = Json::array();
  std::int64_t last_ = 0;
  bool any_ = false;
};

Json metres(double value) { return integer(value, kMilli); }
Json certainty(float value) { return integer(static_cast<double>(value), kCertainty); }
Json spot(const Spot& at) { return Json::array({metres(at.x_m), metres(at.y_m)}); }

Json data_of_picture(const Picture& picture) {
  Json landmarks = Json::array(), roads = Json::array(), walls = Json::array();
  for (const auto& one : picture.landmarks) landmarks.push_back({one.name, metres(one.at.x_m), metres(one.at.y_m)});
  const auto places = [](const std::vector<Spot>& all) {
    Json out = Json::array();
    for (const Spot& at : all) out.push_back(spot(at));
    return out;
  };
  for (const auto& one : picture.roads) {
    roads.push_back({one.name, one.from, one.to, static_cast<int>(one.kind), metres(one.width_m), places(one.along)});
  }
  const auto strokes = [](const std::vector<Picture::Stroke>& all) {
    Json out = Json::array();
    for (const auto& one : all) out.push_back({metres(one.from.x_m), metres(one.from.y_m), metres(one.to.x_m), metres(one.to.y_m), metres(one.width_m)});
    return out;
  };
  for (const auto& one : picture.walls) walls.push_back({metres(one.from.x_m), metres(one.from.y_m), metres(one.to.x_m), metres(one.to.y_m)});
  Json halls = Json::array(), blocks = Json::array();
  for (const auto& one : picture.halls) halls.push_back({metres(one.width_m), places(one.along)});
  for (const auto& one : picture.blocks) blocks.push_back(places(one));
  return {{"low", spot(picture.low)}, {"high", spot(picture.high)}, {"radius", metres(picture.robot_radius_m)}, {"landmarks", std::move(landmarks)},
          {"roads", std::move(roads)}, {"halls", std::move(halls)}, {"blocks", std::move(blocks)}, {"lines", strokes(picture.lines)}, {"stops", strokes(picture.stop_lines)}, {"walls", std::move(walls)}};
}

Json data_of_cells(const MindNames& names, const Kinds& kinds) {
  Json cells = Json::array();
  for (std::size_t i = 0; i < names.cells.size(); ++i) {
    const MindNames::Cell& cell = names.cells[i];
    const int flags = (cell.command ? 1 : 0) + (cell.keep ? 2 : 0);
    cells.push_back({cell.name, static_cast<int>(cell.kind), certainty(cell.initial), flags, kinds.of_cell[i], cell.control, cell.satellites, certainty(cell.plain), certainty(cell.attended)});
  }
  return cells;
}

Json data_of_rules(const MindNames& names) {
  Json rules = Json::array();
  for (const MindNames::Rule& rule : names.rules) {
    const auto level = std::find(names.levels.begin(), names.levels.end(), rule.level) - names.levels.begin();
    Json writes = Json::array();
    for (const auto& write : rule.writes) {
      writes.push_back(write.cell);
      writes.push_back(certainty(write.value));
    }
    rules.push_back({rule.name, level, rule.at, rule.condition, std::move(writes), rule.clears, (rule.reset ? 1 : 0) + (rule.each_tick ? 2 : 0)});
  }
  return rules;
}

Json data_of_conditions(const MindNames& names) {
  using Op = MindNames::Condition::Op;
  Json conditions = Json::array();
  for (const auto& one : names.conditions) {
    Json row = {static_cast<int>(one.op)};
    switch (one.op) {
      case Op::kAnd:
      case Op::kOr:
      case Op::kNot: row.push_back(one.children); break;
      case Op::kFor: row.push_back(one.children), row.push_back(integer(one.duration_s, kTime)); break;
      case Op::kEvent:
      case Op::kLost:
      case Op::kSeen: row.push_back(one.cell); break;
      case Op::kIs: row.push_back(one.cell), row.push_back(static_cast<int>(one.term)); break;
    }
    conditions.push_back(std::move(row));
  }
  return conditions;
}

/// A value for each frame of the span `of`, in the unit `1 / per_unit`; null where the value is not finite or too large.
template <class Of>
Json column(const Recording& recording, Span of, double per_unit, const Of& value) {
  Column out;
  for (std::uint32_t i = of.first; i < of.last; ++i) out.add(integer(value(recording.frames[i]), per_unit));
  return out.take();
}

Json data_of_senses(const Recording& recording, Span of) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const auto sense = [&](double per_unit, bool mts::Senses::*known, const auto& value) {
    return column(recording, of, per_unit, [&](const Frame& frame) { return frame.senses.*known ? static_cast<double>(value(frame.senses)) : kUnknown; });
  };
  Json line = Json::array(), range = Json::array();
  for (std::size_t i = 0; i < mts::kLineSensors; ++i) line.push_back(sense(kCenti, &mts::Senses::line_known, [i](const mts::Senses& s) { return s.line[i]; }));
  for (std::size_t i = 0; i < mts::kRangeFinders; ++i) range.push_back(sense(kCenti, &mts::Senses::range_known, [i](const mts::Senses& s) { return s.range_m[i]; }));
  return {{"line", std::move(line)},
          {"range", std::move(range)},
          {"compass", sense(kMilli, &mts::Senses::heading_known, [](const mts::Senses& s) { return s.heading_rad; })},
          {"x", sense(kMilli, &mts::Senses::odometry_known, [](const mts::Senses& s) { return s.x_m; })},
          {"y", sense(kMilli, &mts::Senses::odometry_known, [](const mts::Senses& s) { return s.y_m; })},
          {"speed", sense(kMilli, &mts::Senses::odometry_known, [](const mts::Senses& s) { return s.speed_m_s; })},
          {"touched", column(recording, of, 1.0, [](const Frame& frame) { return frame.senses.touched ? 1.0 : 0.0; })}};
}

/// For each cell that changed: the frames in which it did, and its new values.
Json data_of_changes(const Recording& recording, Span of) {
  struct Changes { Column frames, values; bool any = false; };
  std::vector<Changes> cells(recording.names.cells.size());
  for (std::uint32_t i = of.first; i < of.last; ++i) {
    for (const Frame::Change& change : recording.frames[i].changed) {
      if (change.cell >= cells.size()) continue;
      cells[change.cell].frames.add(i);
      cells[change.cell].values.add(certainty(change.value));
      cells[change.cell].any = true;
    }
  }
  Json out = Json::array();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].any) out.push_back({i, cells[i].frames.take(), cells[i].values.take()});
  }
  return out;
}

/// A value that mostly stays the same: the frames in which it changed, and its new values.
template <class Of>
Json sparse(const Recording& recording, Span of, const Of& value) {
  Column frames;
  Json values = Json::array();
  for (std::uint32_t i = of.first; i < of.last; ++i) {
    if (i != of.first && value(recording.frames[i]) == value(recording.frames[i - 1])) continue;
    frames.add(i);
    values.push_back(value(recording.frames[i]));
  }
  return Json::array({frames.take(), std::move(values)});
}

/// A list that is mostly empty: the frames in which it is not, and the lists of these.
template <class Of>
Json lists(const Recording& recording, Span of, const Of& list) {
  Column frames;
  Json values = Json::array();
  for (std::uint32_t i = of.first; i < of.last; ++i) {
    if (list(recording.frames[i]).empty()) continue;
    frames.add(i);
    values.push_back(list(recording.frames[i]));
  }
  return Json::array({frames.take(), std::move(values)});
}

Json data_of_firings(const Recording& recording, Span of) {
  Column rules, first, length;
  for (const Firing& firing : firings(recording, of)) {
    rules.add(firing.rule);
    first.add(firing.span.first);
    length.add(firing.span.last - firing.span.first);
  }
  return Json::array({rules.take(), first.take(), length.take()});
}

}  // namespace

Json data_of_drive(const Recording& recording) {
  const Kinds kinds = strategy_kinds(recording.names);
  Json looks = Json::array();
  for (std::size_t i = 0; i < kinds.names.size(); ++i) {
    const Look& look = look_of(static_cast<std::int32_t>(i));
    looks.push_back({kinds.names[i], look.light, look.dark, look.dash});
  }
  Json legs = Json::array();
  for (const auto& leg : recording.legs) legs.push_back({leg.name, leg.from, leg.to, leg.road, leg.detour ? 1 : 0});
  return {{"title", recording.title},
          {"picture", data_of_picture(recording.picture)},
          {"cells", data_of_cells(recording.names, kinds)},
          {"levels", recording.names.levels},
          {"rules", data_of_rules(recording.names)},
          {"conditions", data_of_conditions(recording.names)},
          {"groups", recording.names.exclusive},
          {"firing", certainty(recording.names.firing)},
          {"kinds", std::move(looks)},
          {"noLook", {kNoLook.light, kNoLook.dark, kNoLook.dash}},
          {"legs", std::move(legs)}};
}

Json data_of_frames(const Recording& recording, Span of) {
  Json stays = Json::array();
  for (const auto& stay : recording.stays) {
    stays.push_back({static_cast<int>(stay.thing.kind), stay.thing.name, spot(stay.thing.from), spot(stay.thing.to), stay.first, stay.last});
  }
  return {{"first", of.first},
          {"count", of.last - of.first},
          {"outcome", recording.outcome},
          {"t", column(recording, of, kTime, [](const Frame& frame) { return frame.t_s; })},
          {"x", column(recording, of, kMilli, [](const Frame& frame) { return frame.pose.x_m; })},
          {"y", column(recording, of, kMilli, [](const Frame& frame) { return frame.pose.y_m; })},
          {"h", column(recording, of, kMilli, [](const Frame& frame) { return frame.pose.heading_rad; })},
          {"senses", data_of_senses(recording, of)},
          {"changes", data_of_changes(recording, of)},
          {"events", lists(recording, of, [](const Frame& frame) -> const auto& { return frame.events; })},
          {"lost", lists(recording, of, [](const Frame& frame) -> const auto& { return frame.lost; })},
          {"firings", data_of_firings(recording, of)},
          {"strategy", sparse(recording, of, [](const Frame& frame) { return frame.strategy; })},
          {"status", sparse(recording, of, [](const Frame& frame) -> const auto& { return frame.status; })},
          {"leg", sparse(recording, of, [](const Frame& frame) -> const auto& { return frame.leg; })},
          {"notes", lists(recording, of, [](const Frame& frame) -> const auto& { return frame.notes; })},
          {"stays", std::move(stays)}};
}

std::string print_data(const Json& data) { return safe_in_script(data.dump(-1, ' ', false, Json::error_handler_t::replace)); }

}  // namespace kb::sim::report
