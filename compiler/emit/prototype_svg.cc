#include "compiler/emit/prototype_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "compiler/emit/svg.h"
#include "compiler/fuzzy/certainty.h"
#include "compiler/source/utf8.h"

namespace kb::emit {
namespace {

constexpr std::array<std::string_view, 4> kLines = {kBlue, kGreen, kOrange, kVermilion};
constexpr double kX = 70, kWidth = 560, kHeight = 170;
constexpr int kPoints = 280;

Frame panel_at(double y, double low, double high, double bottom) { return {kX, y, kWidth, kHeight, low, high, bottom, 1.0}; }

// The smallest of 1, 2, 5, 10, ... and their tenths that is not below `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1.0 - 1e-9)) return digit * power;
  }
  return 10.0 * power;
}

class PrototypeDrawing {
 public:
  PrototypeDrawing(const fuzzy::Shape& shape, const PrototypePicture& picture) : shape_(shape), p_(picture) {}

  std::string run() {
    const std::string what = p_.unit.empty() ? p_.sensor : p_.sensor + ", " + p_.unit;
    const auto [low, high] = shown();
    draw_membership(panel_at(60, low, high, 0), what);
    draw_readings(panel_at(60 + kHeight + 80, low, high, -1), what);
    double height = 60 + 2 * (kHeight + 80);
    if (p_.stale_s > 0.0) {
      draw_ageing(panel_at(height, 0, 0.5 * p_.stale_s, -1));
      height += kHeight + 80;
    }
    return svg_.picture(kX + kWidth + 170, height - 15, kX, p_.sensor + " ~ " + p_.prototype);
  }

 private:
  using Curve = std::vector<std::pair<double, double>>;

  void words(double x, double y, std::string_view anchor, std::string_view text, std::string_view colour = "#333333") {
    svg_.text(x, y, anchor, source::escape_markup(text), colour);
  }
  void stroke(double x1, double y1, double x2, double y2) { svg_.line(x1, y1, x2, y2, "#bbbbbb"); }
  void draw_axes(const Frame& panel, std::string_view title, std::string_view below) {
    words(kX, panel.y - 10, "start", title, "#000000");
    const double step = round_step((panel.high - panel.low) / 5), nearly = 1e-6;
    for (double i = std::ceil(panel.low / step - nearly) + 0.0; i <= panel.high / step + nearly; ++i) {
      words(panel.px(i * step), panel.y + kHeight + 17, "middle", fmt::format("{:.4g}", i * step));
    }
    for (int i = 0; i <= 2; ++i) {
      const double v = panel.bottom + (panel.top - panel.bottom) * i / 2;
      stroke(kX, panel.py(v), kX + kWidth, panel.py(v));
      words(kX - 8, panel.py(v) + 4, "end", fmt::format("{:g}", v));
    }
    stroke(kX, panel.y, kX, panel.y + kHeight);
    words(kX + kWidth / 2, panel.y + kHeight + 34, "middle", below, "#000000");
  }
  void draw_key(const Frame& panel, std::size_t line, std::string_view text) {
    words(kX + kWidth + 12, panel.y + 14 + 18 * static_cast<double>(line), "start", text, kLines[line]);
  }
  template <class F>
  [[nodiscard]] static Curve curve(const Frame& panel, F value) {
    Curve points;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = panel.low + (panel.high - panel.low) * i / kPoints;
      points.emplace_back(x, value(x));
    }
    return points;
  }
  [[nodiscard]] std::string with_unit(double v) const { return fmt::format("{:.3g}{}{}", v, p_.unit.empty() ? "" : " ", p_.unit); }
  [[nodiscard]] double spread(double age_s) const { return std::sqrt(p_.noise * p_.noise + p_.growth * age_s); }

  void draw_membership(const Frame& panel, std::string_view what) {
    draw_axes(panel, "how well a value fits", what);
    svg_.curve(panel, curve(panel, [&](double x) { return fuzzy::mu(shape_, x); }), kLines[0]);
    draw_key(panel, 0, p_.prototype);
    if (!(p_.noise > 0.0)) return;
    const double read = where(0.5, best());
    svg_.curve(panel, curve(panel, [&](double x) { return std::exp(-0.5 * (x - read) * (x - read) / (p_.noise * p_.noise)); }), kLines[1]);
    draw_key(panel, 1, "a reading of " + with_unit(read));
  }
  /// The part of the range that is shown: the flanks with what lies between them, and one and a half times as much on each side.
  [[nodiscard]] std::pair<double, double> shown() const {
    double first = p_.high, last = p_.low;
    const double step = (p_.high - p_.low) / (16 * kPoints);
    for (int i = 0; i <= 16 * kPoints; ++i) {
      const double x = p_.low + step * i, fits = fuzzy::mu(shape_, x);
      if (fits <= 0.01 || fits >= 0.99) continue;
      first = std::min(first, x);
      last = std::max(last, x);
    }
    if (!(last > first)) return {p_.low, p_.high};
    const double more = 1.5 * (last - first);
    return {std::max(p_.low, first - more), std::min(p_.high, last + more)};
  }

  /// Draws a fresh reading and the same at three ages; if readings do not age, an exact reading and three spreads.
  void draw_readings(const Frame& panel, std::string_view what) {
    draw_axes(panel, "certainty, by what was read and how wide the reading is", what);
    for (std::size_t i = 0; i < kLines.size(); ++i) {
      const double part = i == 0 ? 0.0 : std::pow(10.0, static_cast<double>(i) - 3.0);   // 1 %, 10 %, all of `stale`
      const double wide = p_.stale_s > 0.0 ? spread(part * p_.stale_s)
                                           : static_cast<double>(i) * std::max(p_.noise, 0.02 * (p_.high - p_.low));
      svg_.curve(panel, curve(panel, [&](double x) { return fuzzy::certainty(shape_, x, wide); }), kLines[i]);
      draw_key(panel, i, wide > 0.0 ? "spread " + with_unit(wide) : std::string("exact"));
    }
  }

  void draw_ageing(const Frame& panel) {
    draw_axes(panel, "certainty, by age", fmt::format("age, s (stale {:g} s)", p_.stale_s));
    std::array<double, 3> readings = {best(), 0.0, 0.0};
    readings[1] = where(0.5, readings[0]);
    readings[2] = where(0.05, readings[0]);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      svg_.curve(panel, curve(panel, [&](double age) { return fuzzy::certainty(shape_, readings[i], spread(age)); }), kLines[i]);
      draw_key(panel, i, "read " + with_unit(readings[i]));
    }
  }
  /// The middle of the part of the range that fits best.
  [[nodiscard]] double best() const {
    double most = -1.0, first = p_.low, last = p_.low;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = p_.low + (p_.high - p_.low) * i / kPoints, fits = fuzzy::mu(shape_, x);
      if (fits > most + 1e-9) most = fits, first = x;
      if (fits > most - 1e-9) last = x;
    }
    return 0.5 * (first + last);
  }
  /// The place to the right of `from` that fits no better than `degree`; if there is none, the place to the left.
  [[nodiscard]] double where(double degree, double from) const {
    const double step = (p_.high - p_.low) / kPoints;
    for (double x = from; x <= p_.high; x += step) if (fuzzy::mu(shape_, x) <= degree) return x;
    for (double x = from; x >= p_.low; x -= step) if (fuzzy::mu(shape_, x) <= degree) return x;
    return from;
  }

  const fuzzy::Shape& shape_;
  const PrototypePicture& p_;
  Svg svg_;
};

}  // namespace

std::string print_prototype_svg(const fuzzy::Shape& shape, const PrototypePicture& picture) { return PrototypeDrawing(shape, picture).run(); }

}  // namespace kb::emit
