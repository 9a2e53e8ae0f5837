#include "planners/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compiler/source/utf8.h"

namespace kb::planners {
namespace {

constexpr double kPanelPx = 520.0;    // the longer side of a map
constexpr double kMarginPx = 14.0, kTitlePx = 24.0, kCaptionPx = 20.0, kRemarkPx = 16.0;
constexpr double kCaptionFont = 13.0, kRemarkFont = 11.0, kPerLetter = 0.56;   // the width of a letter as a share of the font's size, enough for most texts
constexpr std::size_t kBands = 24;    // shades of a field

// From light blue near the goal to sand far away; dark lines stand out on all of these.
std::string shade(std::size_t band) {
  const double t = static_cast<double>(band) / static_cast<double>(kBands - 1);
  const auto mix = [&](double a, double b) { return static_cast<int>(std::lround(a + t * (b - a))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(150, 252), mix(196, 238), mix(232, 208));
}

class PanelDrawer {
 public:
  PanelDrawer(const Panel& panel, double x, double y, std::string& out)
      : panel_(panel), grid_(*panel.problem->grid), out_(out), x_(x + kMarginPx), y_(y + kTitlePx + kMarginPx) {
    px_ = kPanelPx / std::max(grid_.width(), grid_.height());
  }

  void draw() {
    text(0.0, -8.0, 15, "bold", panel_.title);
    rectangle();
    field();
    basin();
    blocked();
    lines();
    path();
    ends();
    traps();
    double below = grid_.height() * px_ + kCaptionPx - 4.0;
    text(0.0, below, kCaptionFont, "normal", panel_.caption);
    for (const std::string& remark : panel_.picture.remarks) text(0.0, below += kRemarkPx, kRemarkFont, "normal", remark);
  }

  static std::pair<double, double> size(const Panel& panel) {
    const Grid& grid = *panel.problem->grid;
    const double px = kPanelPx / std::max(grid.width(), grid.height());
    const double remarks = kRemarkPx * static_cast<double>(panel.picture.remarks.size());
    // A map may be narrower than the text under it.
    const auto written = [](std::string_view words, double font) { return kPerLetter * font * static_cast<double>(words.size()); };
    double width = std::max({grid.width() * px, 260.0, written(panel.caption, kCaptionFont)});
    for (const std::string& remark : panel.picture.remarks) width = std::max(width, written(remark, kRemarkFont));
    return {width + 2 * kMarginPx, grid.height() * px + kTitlePx + kCaptionPx + remarks + 2 * kMarginPx};
  }

 private:
  template <class... Arguments>
  void put(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out_), form, std::forward<Arguments>(arguments)...);
  }
  double sx(Point p) const { return x_ + (p.x - grid_.origin_m().x) / grid_.cell_m() * px_; }
  double sy(Point p) const { return y_ + (grid_.height() - (p.y - grid_.origin_m().y) / grid_.cell_m()) * px_; }

  void text(double x, double y, double size, std::string_view weight, std::string_view words) {
    put("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" font-weight=\"{}\">{}</text>\n", x_ + x, y_ + y, size, weight,
        source::escape_markup(words));
  }
  void rectangle() {
    put("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#fff\" stroke=\"#333\"/>\n", x_, y_,
        grid_.width() * px_, grid_.height() * px_);
  }

  // Draws all cells for which `in` holds as one path; adjacent cells of a row are joined.
  template <class In>
  void cells(std::string_view style, const In& in) {
    std::string d;
    for (std::int32_t y = 0; y < grid_.height(); ++y) {
      for (std::int32_t x = 0; x < grid_.width(); ++x) {
        if (!in(Cell{x, y})) continue;
        std::int32_t end = x + 1;
        while (end < grid_.width() && in(Cell{end, y})) ++end;
        fmt::format_to(std::back_inserter(d), "M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z", x_ + x * px_,
                       y_ + (grid_.height() - 1 - y) * px_, (end - x) * px_, px_, -(end - x) * px_);
        x = end;
      }
    }
    if (!d.empty()) put("<path d=\"{}\" {}/>\n", d, style);
  }

  void field() {
    const std::vector<double>& field = panel_.picture.field;
    if (field.empty()) return;
    // Bands hold equally many cells, so that the look of a steep field does not depend on its largest value.
    std::vector<double> sorted;
    for (const double v : field) {
      if (std::isfinite(v)) sorted.push_back(v);
    }
    if (sorted.empty()) return;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint8_t> bands(field.size(), kBands);
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (!std::isfinite(field[i]) || grid_.all_blocked()[i] != 0) continue;
      const auto rank = static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), field[i]) - sorted.begin());
      bands[i] = static_cast<std::uint8_t>(std::min(kBands - 1, rank * kBands / sorted.size()));
    }
    for (std::size_t band = 0; band < kBands; ++band) {
      cells(fmt::format("fill=\"{}\" shape-rendering=\"crispEdges\"", shade(band)),
            [&](Cell cell) { return bands[grid_.index(cell)] == band; });
    }
  }
  void basin() {
    if (panel_.picture.basin.empty()) return;
    cells("fill=\"#2a9d5c\" fill-opacity=\"0.28\" shape-rendering=\"crispEdges\"",
          [&](Cell cell) { return panel_.picture.basin[grid_.index(cell)] != 0; });
  }
  void blocked() {
    const Grid& stands = panel_.obstacles != nullptr ? *panel_.obstacles : grid_;
    cells("fill=\"#c3c7d0\" shape-rendering=\"crispEdges\"", [&](Cell cell) { return grid_.blocked(cell) && stands.free(cell); });
    cells("fill=\"#3d4047\" shape-rendering=\"crispEdges\"", [&](Cell cell) { return stands.blocked(cell); });
  }

  void polyline(const std::vector<Point>& points, std::string_view style) {
    if (points.size() < 2) return;
    std::string d;
    // Points nearer than three pixels to the one before would only make the file larger.
    double x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool end = i == 0 || i + 1 == points.size();
      if (!end && std::hypot(sx(points[i]) - x, sy(points[i]) - y) < 3.0) continue;
      x = sx(points[i]);
      y = sy(points[i]);
      fmt::format_to(std::back_inserter(d), "{:.1f},{:.1f} ", x, y);
    }
    d.pop_back();
    put("<polyline points=\"{}\" fill=\"none\" {}/>\n", d, style);
  }
  void lines() {
    for (const auto& line : panel_.picture.lines) {
      polyline(line, "stroke=\"#5b6b8c\" stroke-width=\"0.7\" stroke-opacity=\"0.7\"");
    }
  }
  void path() {
    const bool there = panel_.result->outcome == Outcome::kReached;
    polyline(panel_.result->path, there ? "stroke=\"#c8102e\" stroke-width=\"2.2\" stroke-linejoin=\"round\""
                                        : "stroke=\"#e07b00\" stroke-width=\"1.6\" stroke-linejoin=\"round\"");
  }
  void ends() {
    const Problem& problem = *panel_.problem;
    put("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4.5\" fill=\"#fff\" stroke=\"#111\" stroke-width=\"1.6\"/>\n",
        sx(problem.start), sy(problem.start));
    put("<circle cx=\"{0:.2f}\" cy=\"{1:.2f}\" r=\"5\" fill=\"#111\"/><circle cx=\"{0:.2f}\" cy=\"{1:.2f}\" r=\"2\" fill=\"#fff\"/>\n",
        sx(problem.goal), sy(problem.goal));
  }
  void cross(Point at) {
    put("<path d=\"M{:.2f} {:.2f}l8 8m0 -8l-8 8\" stroke=\"#7a0099\" stroke-width=\"2.4\"/>\n", sx(at) - 4, sy(at) - 4);
  }
  void traps() {
    for (const Trap& trap : panel_.picture.traps) cross(trap.at);
    if (panel_.result->outcome == Outcome::kTrapped) cross(panel_.result->trap.at);
  }

  const Panel& panel_;
  const Grid& grid_;
  std::string& out_;
  double x_, y_, px_ = 1.0;
};

}  // namespace

std::string draw_svg(const std::vector<Panel>& panels, std::size_t columns) {
  columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
  double width = 0.0, height = 0.0;
  for (const Panel& panel : panels) {
    const auto [w, h] = PanelDrawer::size(panel);
    width = std::max(width, w);
    height = std::max(height, h);
  }
  const auto rows = static_cast<double>((panels.size() + columns - 1) / columns);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width * static_cast<double>(columns), height * rows);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    PanelDrawer(panels[i], width * static_cast<double>(i % columns), height * static_cast<double>(i / columns), out).draw();
  }
  return out + "</svg>\n";
}

}  // namespace kb::planners
