#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compiler/source/utf8.h"
#include "sim/report/kinds.h"
#include "sim/report/report.h"
#include "sim/report/spans.h"
#include "sim/report/text.h"

namespace kb::sim::report {
namespace {

constexpr double kFloorPx = 760.0;     // the longer side of the floor
constexpr double kMarginPx = 28.0, kTitlePx = 46.0, kRowPx = 20.0, kLegendPx = 300.0;
constexpr double kNearPx = 2.0;        // points of the track nearer to each other than this would only make the file larger
constexpr std::string_view kInk = "#1f2328", kFaint = "#6b7280", kAlarm = "#b44a00";

class Still {
 public:
  explicit Still(const Recording& recording) : recording_(recording), kinds_(strategy_kinds(recording.names)) {
    const Picture& picture = recording.picture;
    const double wide = picture.high.x_m - picture.low.x_m, high = picture.high.y_m - picture.low.y_m;
    sound_ = std::isfinite(wide) && std::isfinite(high) && wide >= 0.0 && high >= 0.0 && std::max(wide, high) > 0.0;
    low_ = sound_ ? picture.low : Spot{};
    wide_ = sound_ ? wide : 1.0;
    high_ = sound_ ? high : 1.0;
    px_ = kFloorPx / std::max(wide_, high_);
    legend_x_ = wide_ * px_ + 2 * kMarginPx;
  }

  std::string run() {
    draw_roads();
    draw_paint();
    draw_things();
    draw_track();
    draw_robot();
    draw_landmarks();
    draw_notes();
    draw_legend();
    const double width = legend_x_ + kLegendPx, height = std::max(high_ * px_ + 2 * kMarginPx + kTitlePx, legend_y_ + kMarginPx);
    std::string all = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" role=\"img\" "
        "font-family=\"system-ui, sans-serif\" font-size=\"13\">\n<title>{2}</title>\n",
        width, height, source::escape_markup(recording_.title));
    all +=
        "<defs><pattern id=\"hatch\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">"
        "<rect width=\"6\" height=\"6\" fill=\"#fff\"/><rect width=\"2.4\" height=\"6\" fill=\"#3d4047\"/></pattern></defs>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    all += fmt::format("<text x=\"{}\" y=\"30\" font-size=\"17\" font-weight=\"600\" fill=\"{}\">{}</text>\n", kMarginPx, kInk, source::escape_markup(recording_.title));
    return all + out_ + "</svg>\n";
  }

 private:
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), form, std::forward<Arguments>(arguments)...);
  }
  [[nodiscard]] double sx(double x_m) const { return kMarginPx + (x_m - low_.x_m) * px_; }
  [[nodiscard]] double sy(double y_m) const { return kMarginPx + kTitlePx + (high_ - (y_m - low_.y_m)) * px_; }
  static bool finite(const Pose& pose) { return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad); }
  static bool finite(const Spot& a, const Spot& b) { return std::isfinite(a.x_m + a.y_m + b.x_m + b.y_m); }

  void text(double x, double y, std::string_view style, std::string_view words) { put("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, source::escape_markup(words)); }
  void line(const Spot& from, const Spot& to, std::string_view style) {
    if (finite(from, to)) put("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", sx(from.x_m), sy(from.y_m), sx(to.x_m), sy(to.y_m), style);
  }

  /// The data of a path along a chain of places; places that are not finite are left out.
  [[nodiscard]] std::string chain(const std::vector<Spot>& along) const {
    std::string d;
    for (const Spot& at : along) {
      if (finite(at, at)) fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", d.empty() ? "M" : "L", sx(at.x_m), sy(at.y_m));
    }
    return d;
  }
  void draw_roads() {
    for (const auto& hall : recording_.picture.halls) {
      const std::string d = chain(hall.along);
      if (!d.empty() && std::isfinite(hall.width_m)) {
        put("<path d=\"{}\" fill=\"none\" stroke=\"#f4f0e6\" stroke-width=\"{:.1f}\" stroke-linejoin=\"miter\"/>\n", d, std::max(3.0, hall.width_m * px_));
      }
    }
    for (const auto& road : recording_.picture.roads) {
      const std::string d = chain(road.along);
      if (d.empty()) continue;
      const double width = std::isfinite(road.width_m) ? std::max(3.0, road.width_m * px_) : 3.0;
      put("<path d=\"{}\" fill=\"none\" stroke=\"#eceff3\" stroke-width=\"{:.1f}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n", d, width);
      // Nothing on the floor marks such a road, so the picture draws a dotted line.
      if (road.kind == Picture::Kind::kAzimuth) put("<path d=\"{}\" fill=\"none\" stroke=\"#a8afb9\" stroke-width=\"1.2\" stroke-dasharray=\"1 5\" stroke-linecap=\"round\"/>\n", d);
    }
  }
  void draw_paint() {
    for (const auto& corners : recording_.picture.blocks) put("<path d=\"{}Z\" fill=\"url(#hatch)\"/>\n", chain(corners));
    for (const auto& one : recording_.picture.lines) line(one.from, one.to, fmt::format("stroke=\"#3d4047\" stroke-width=\"{:.1f}\"", paint_px(one.width_m)));
    for (const auto& one : recording_.picture.stop_lines) line(one.from, one.to, fmt::format("stroke=\"#000\" stroke-width=\"{:.1f}\"", paint_px(one.width_m)));
    for (const auto& one : recording_.picture.walls) line(one.from, one.to, "stroke=\"#59606b\" stroke-width=\"2.6\" stroke-linecap=\"round\"");
  }
  [[nodiscard]] double paint_px(double width_m) const { return std::isfinite(width_m) ? std::clamp(width_m * px_, 1.4, 8.0) : 1.4; }

  // Draws what stood on the floor when the drive ended.
  void draw_things() {
    for (const auto& stay : recording_.stays) {
      if (stay.last < recording_.frames.size() || !finite(stay.thing.from, stay.thing.to)) continue;
      const Thing& thing = stay.thing;
      const double x = sx((thing.from.x_m + thing.to.x_m) / 2), y = sy((thing.from.y_m + thing.to.y_m) / 2);
      switch (thing.kind) {
        case Thing::Kind::kObstacle:
          put("<ellipse cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"{:.1f}\" ry=\"{:.1f}\" fill=\"url(#hatch)\" stroke=\"#1f2328\"/>\n", x, y,
              std::abs(thing.to.x_m - thing.from.x_m) * px_ / 2, std::abs(thing.to.y_m - thing.from.y_m) * px_ / 2);
          break;
        case Thing::Kind::kClosedRoad:
          draw_closed(thing);
          break;
        case Thing::Kind::kLostMarking:
          line(thing.from, thing.to, "stroke=\"#fff\" stroke-width=\"6\" stroke-opacity=\"0.85\"");
          line(thing.from, thing.to, "stroke=\"#8a6a00\" stroke-width=\"2\" stroke-dasharray=\"1 6\"");
          break;
        case Thing::Kind::kUnsafeCrossing:
          put("<path d=\"M{:.1f} {:.1f}l9 16h-18z\" fill=\"#fff\" stroke=\"{}\" stroke-width=\"2\"/>\n", x, y - 25, kAlarm);
          text(x, y - 11.5, fmt::format("text-anchor=\"middle\" font-weight=\"700\" fill=\"{}\"", kAlarm), "!");
          break;
      }
    }
  }

  // Draws a closed road along all its bends, with a cross on its middle piece.
  void draw_closed(const Thing& thing) {
    std::vector<Spot> along = {thing.from, thing.to};
    for (const auto& road : recording_.picture.roads) {
      if (road.name == thing.name && road.along.size() > 1) along = road.along;
    }
    for (std::size_t i = 1; i < along.size(); ++i) line(along[i - 1], along[i], fmt::format("stroke=\"{}\" stroke-width=\"5\" stroke-dasharray=\"3 5\"", kAlarm));
    const Spot& a = along[(along.size() - 1) / 2];
    const Spot& b = along[along.size() / 2];
    if (!finite(a, b)) return;
    put("<path d=\"M{:.1f} {:.1f}l14 14m0 -14l-14 14\" stroke=\"{}\" stroke-width=\"3.4\"/>\n", sx((a.x_m + b.x_m) / 2) - 7, sy((a.y_m + b.y_m) / 2) - 7, kAlarm);
  }

  [[nodiscard]] std::int32_t kind_of(const Frame& frame) const {
    const auto cell = static_cast<std::size_t>(frame.strategy);
    return frame.strategy < 0 || cell >= kinds_.of_cell.size() ? -1 : kinds_.of_cell[cell];
  }
  void draw_track() {
    const auto& frames = recording_.frames;
    for (const Span span : equal_spans(frames, [&](const Frame& frame) { return kind_of(frame); })) {
      std::string d;
      double x = 0.0, y = 0.0;
      // A stretch is drawn up to the first point of the next one, so that no gap shows.
      const std::uint32_t last = std::min<std::uint32_t>(span.last, static_cast<std::uint32_t>(frames.size()) - 1);
      for (std::uint32_t i = span.first; i <= last; ++i) {
        if (!finite(frames[i].pose)) continue;
        const double px = sx(frames[i].pose.x_m), py = sy(frames[i].pose.y_m);
        if (!d.empty() && i != last && std::hypot(px - x, py - y) < kNearPx) continue;
        fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", d.empty() ? "M" : "L", x = px, y = py);
      }
      const std::int32_t kind = kind_of(frames[span.first]);
      const Look& look = look_of(kind);
      // A white track lies under the coloured one: on a painted line a dotted track could not be seen otherwise.
      if (!d.empty()) {
        put("<path d=\"{}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"5\" stroke-linejoin=\"round\"/>\n", d);
        put("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\"{}/>\n", d, look.light, dash(look));
      }
      used_.resize(kinds_.names.size() + 1, false);
      used_[static_cast<std::size_t>(kind + 1)] = true;
    }
  }
  static std::string dash(const Look& look) { return look.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", look.dash); }

  void draw_landmarks() {
    const bool crowded = recording_.picture.landmarks.size() > 30;
    const double name_px = crowded ? 10.0 : 13.0;
    for (const auto& landmark : recording_.picture.landmarks) {
      if (!finite(landmark.at, landmark.at)) continue;
      const double x = sx(landmark.at.x_m), y = sy(landmark.at.y_m);
      put("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"9\" rx=\"2\" fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", x - 4.5, y - 4.5, kInk);
      const std::string size = crowded ? fmt::format("font-size=\"{}\" ", name_px) : "";
      text(x + 8, y - 8, fmt::format("{}font-weight=\"600\" fill=\"{}\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"", size, kInk), landmark.name);
      legend_x_ = std::max(legend_x_, x + 0.65 * name_px * static_cast<double>(landmark.name.size()) + kMarginPx);
    }
  }

  void draw_robot() {
    if (recording_.frames.empty() || !finite(recording_.frames.back().pose)) return;
    const Pose& pose = recording_.frames.back().pose;
    const double radius = std::max(7.0, std::isfinite(recording_.picture.robot_radius_m) ? recording_.picture.robot_radius_m * px_ : 7.0);
    put("<g transform=\"translate({:.1f} {:.1f}) rotate({:.1f})\"><circle r=\"{:.1f}\" fill=\"#fff\" stroke=\"{}\" stroke-width=\"2\"/>"
        "<path d=\"M{:.1f} 0L{:.1f} {:.1f}L{:.1f} {:.1f}z\" fill=\"{}\"/></g>\n",
        sx(pose.x_m), sy(pose.y_m), -pose.heading_rad * 57.29577951308232, radius, kInk, radius * 0.8, -radius * 0.45, radius * 0.5, -radius * 0.45, -radius * 0.5, kInk);
  }

  // All notes of a frame share one mark.
  void draw_notes() {
    std::size_t number = 0;
    for (const Frame& frame : recording_.frames) {
      if (frame.notes.empty()) continue;
      for (const std::string& note : frame.notes) notes_.emplace_back(frame.t_s, note);
      const std::string label = frame.notes.size() > 1 ? fmt::format("{}\u2013{}", number + 1, number + frame.notes.size()) : fmt::format("{}", number + 1);
      number += frame.notes.size();
      if (!finite(frame.pose)) continue;
      const double x = sx(frame.pose.x_m) - 16, y = sy(frame.pose.y_m) + 16, half = frame.notes.size() > 1 ? 15.0 : 8.5;
      put("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"17\" rx=\"8.5\" fill=\"{}\"/>", x - half, y - 8.5, 2 * half, kInk);
      text(x, y + 3.6, "text-anchor=\"middle\" font-size=\"10.5\" font-weight=\"700\" fill=\"#fff\"", label);
    }
  }

  void draw_legend() {
    const double x = legend_x_;
    legend_y_ = kMarginPx + kTitlePx;
    if (!recording_.outcome.empty()) row(x, "font-weight=\"600\"", recording_.outcome);
    for (std::size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i]) continue;
      const Look& look = look_of(static_cast<std::int32_t>(i) - 1);
      put("<path d=\"M{:.1f} {:.1f}h34\" stroke=\"{}\" stroke-width=\"3\"{}/>\n", x, legend_y_ - 4, look.light, dash(look));
      row(x + 44, "", i == 0 ? "no strategy" : kinds_.names[i - 1]);
    }
    legend_y_ += 8;
    for (std::size_t i = 0; i < notes_.size(); ++i) {
      const std::string at = std::isfinite(notes_[i].first) ? fixed(notes_[i].first, 2) : "?";
      std::string number = fmt::format("{}", i + 1);
      for (const std::string& words : wrapped(fmt::format("{} s: {}", at, notes_[i].second))) {
        if (!number.empty()) text(x, legend_y_, fmt::format("font-size=\"12\" font-weight=\"700\" fill=\"{}\"", kInk), number);
        number.clear();
        row(x + 26, fmt::format("font-size=\"12\" fill=\"{}\"", kFaint), words);
      }
    }
  }
  /// The words broken at blanks into lines that fit beside the floor.
  static std::vector<std::string> wrapped(const std::string& words) {
    constexpr std::size_t kMost = 40;
    std::vector<std::string> lines = {""};
    std::size_t from = 0;
    while (from < words.size()) {
      const std::size_t end = std::min(words.find(' ', from), words.size());
      if (!lines.back().empty() && lines.back().size() + end - from + 1 > kMost) lines.emplace_back();
      lines.back() += (lines.back().empty() ? "" : " ") + words.substr(from, end - from);
      from = end + 1;
    }
    return lines;
  }
  void row(double x, std::string_view style, std::string_view words) {
    text(x, legend_y_, style, words);
    legend_y_ += kRowPx;
  }

  const Recording& recording_;
  const Kinds kinds_;
  bool sound_ = false;
  Spot low_;
  double wide_ = 1.0, high_ = 1.0, px_ = 1.0, legend_x_ = 0.0, legend_y_ = 0.0;
  std::vector<bool> used_;   // by kind + 1
  std::vector<std::pair<double, std::string>> notes_;
  std::string out_;
};

}  // namespace

std::string svg(const Recording& recording) { return Still(recording).run(); }

}  // namespace kb::sim::report
