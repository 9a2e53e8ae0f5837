#include "compiler/emit/fuzzy_svg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/emit/svg.h"
#include "compiler/fuzzy/interpret.h"
#include "compiler/source/utf8.h"

namespace kb::emit {
namespace {

constexpr std::array<std::string_view, 8> kColours = {kBlue, kVermilion, kGreen, kPurple, kOrange, kSky, kOlive, kBlack};

constexpr double kPlotWidth = 560, kTermsHeight = 110, kLeft = 70, kGap = 40, kRow = 13, kSurface = 360;
constexpr int kCurvePoints = 560, kCells = 72;

std::string axis_name(std::string_view name, std::string_view unit) {
  return unit.empty() ? source::escape_markup(name) : fmt::format("{}, {}", source::escape_markup(name), source::escape_markup(unit));
}

// A colour from blue over white-green to yellow, with evenly rising lightness, for a share from 0 to 1.
std::string colour(double share) {
  constexpr double kStops[][3] = {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
  const double at = std::clamp(share, 0.0, 1.0) * 4.0;
  const auto i = static_cast<std::size_t>(std::min(3.0, std::floor(at)));
  const double part = at - static_cast<double>(i);
  const auto mix = [&](std::size_t c) { return static_cast<int>(std::lround(kStops[i][c] + part * (kStops[i + 1][c] - kStops[i][c]))); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

class Drawing {
 public:
  Drawing(const fuzzy::Controller& c, const FuzzyPicture& picture) : c_(c), picture_(picture) {}

  std::string run() {
    double y = 34;
    for (const fuzzy::Input& input : c_.inputs) {
      y += kRow * static_cast<double>(place_names(input)) + 4;
      draw_terms(input, y);
      y += kTermsHeight + kGap;
    }
    y += 26;
    picture_.y == fuzzy::kNone ? draw_curve(y) : draw_surface(y);
    const double height = y + (picture_.y == fuzzy::kNone ? kTermsHeight * 1.6 : kSurface) + 60;
    return svg_.picture(kLeft + kPlotWidth + 80, height, kLeft, c_.name);
  }

 private:
  /// Draws five numbers along the bottom and three along the left side.
  void draw_axes(const Frame& f, std::string_view name, bool left_numbers) {
    svg_.add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#999999\"/>\n", f.x, f.y, f.width, f.height);
    for (int i = 0; i <= 4; ++i) {
      const double v = f.low + (f.high - f.low) * i / 4;
      svg_.line(f.px(v), f.y + f.height, f.px(v), f.y + f.height + 4, "#999999");
      svg_.text(f.px(v), f.y + f.height + 17, "middle", fmt::format("{:.4g}", v));
    }
    for (int i = 0; left_numbers && i <= 2; ++i) {
      const double v = f.bottom + (f.top - f.bottom) * i / 2;
      svg_.line(f.x - 4, f.py(v), f.x, f.py(v), "#999999");
      svg_.text(f.x - 8, f.py(v) + 4, "end", fmt::format("{:.4g}", v));
    }
    svg_.text(f.x + f.width / 2, f.y + f.height + 33, "middle", name, "#000000");
  }

  struct Name { double x = 0.0; std::size_t row = 0; };

  /// Places the names of terms: over the middle of the best fit, in the first row in which a name touches no other. Returns the number of
  /// rows.
  std::size_t place_names(const fuzzy::Input& input) {
    constexpr double kLetter = 6.6;
    names_.clear();
    std::vector<std::vector<std::pair<double, double>>> rows;
    for (const fuzzy::Term& term : input.terms) {
      const double half = 0.5 * kLetter * static_cast<double>(term.name.size()) + 2.0;
      const double x = std::clamp(kLeft + kPlotWidth * best_place(input, term), kLeft + half, kLeft + kPlotWidth - half);
      std::size_t row = 0;
      const auto touches = [&](const std::pair<double, double>& other) { return x - half < other.second && x + half > other.first; };
      while (row < rows.size() && std::any_of(rows[row].begin(), rows[row].end(), touches)) ++row;
      if (row == rows.size()) rows.emplace_back();
      rows[row].emplace_back(x - half, x + half);
      names_.push_back({x, row});
    }
    return rows.size();
  }

  /// The middle of the first stretch on which the degree is highest, as a share of the range.
  static double best_place(const fuzzy::Input& input, const fuzzy::Term& term) {
    double best = -1.0;
    int first = 0, last = 0;
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double degree = fuzzy::mu(term.shape, input.low + (input.high - input.low) * i / kCurvePoints);
      if (degree > best + 1e-9) {
        best = degree;
        first = last = i;
      } else if (degree > best - 1e-9 && last == i - 1) {
        last = i;
      }
    }
    return 0.5 * (first + last) / kCurvePoints;
  }

  void draw_terms(const fuzzy::Input& input, double y) {
    const Frame f{kLeft, y, kPlotWidth, kTermsHeight, input.low, input.high, 0.0, 1.0};
    const std::string group = input.group ? fmt::format("{}[0..{}]", input.name, input.count - 1) : input.name;
    draw_axes(f, axis_name(group, input.unit), true);
    for (std::size_t t = 0; t < input.terms.size(); ++t) {
      const fuzzy::Term& term = input.terms[t];
      const std::string_view colour = kColours[t % kColours.size()];
      std::vector<std::pair<double, double>> points;
      for (int i = 0; i <= kCurvePoints; ++i) {
        const double x = input.low + (input.high - input.low) * i / kCurvePoints;
        const double degree = fuzzy::mu(term.shape, x);
        points.emplace_back(x, degree);
      }
      svg_.curve(f, points, colour);
      svg_.text(names_[t].x, y - 4 - kRow * static_cast<double>(names_[t].row), "middle", source::escape_markup(term.name), colour);
    }
  }

  [[nodiscard]] const fuzzy::Input& input(std::uint32_t slot) const { return c_.inputs[input_of_slot(c_, slot)]; }

  [[nodiscard]] double answer(double x, double y) const {
    std::vector<double> at = picture_.at;
    at[picture_.x] = x;
    if (picture_.y != fuzzy::kNone) at[picture_.y] = y;
    return fuzzy::interpret(c_, at).outputs[picture_.output];
  }

  [[nodiscard]] std::string others() const {
    std::string out;
    for (const fuzzy::Input& input : c_.inputs) {
      std::vector<std::string> numbers;
      for (std::uint32_t slot = input.first_slot; slot < input.first_slot + input.count; ++slot) {
        if (slot != picture_.x && slot != picture_.y) numbers.push_back(fmt::format("{:.4g}", picture_.at[slot]));
      }
      if (numbers.empty()) continue;
      const bool same = std::all_of(numbers.begin(), numbers.end(), [&](const std::string& one) { return one == numbers.front(); });
      fmt::format_to(std::back_inserter(out), "{}{} = {}", out.empty() ? " at " : ", ", source::escape_markup(input.name), same ? numbers.front() : fmt::format("{}", fmt::join(numbers, " ")));
    }
    return out;
  }

  void draw_title(double y) {
    const fuzzy::Output& output = c_.outputs[picture_.output];
    svg_.add("<text x=\"{}\" y=\"{:.1f}\" font-size=\"13\"><tspan font-weight=\"bold\">{}</tspan>{}</text>\n", kLeft, y - 10,
                   axis_name(output.name, output.unit), others());
  }

  void draw_curve(double y) {
    const fuzzy::Output& output = c_.outputs[picture_.output];
    const fuzzy::Input& in = input(picture_.x);
    const Frame f{kLeft, y, kPlotWidth, kTermsHeight * 1.6, in.low, in.high, output.low, output.high};
    draw_title(y);
    draw_axes(f, axis_name(slot_name(c_, picture_.x), in.unit), true);
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i <= kCurvePoints; ++i) {
      const double x = in.low + (in.high - in.low) * i / kCurvePoints;
      points.emplace_back(x, answer(x, 0.0));
    }
    svg_.curve(f, points, kColours[0]);
  }

  void draw_surface(double y) {
    const fuzzy::Output& output = c_.outputs[picture_.output];
    const fuzzy::Input& across = input(picture_.x);
    const fuzzy::Input& up = input(picture_.y);
    const Frame f{kLeft, y, kPlotWidth - 110, kSurface, across.low, across.high, up.low, up.high};
    draw_title(y);
    const double width = f.width / kCells, height = f.height / kCells;
    svg_.add("<g shape-rendering=\"crispEdges\">\n");
    for (int j = 0; j < kCells; ++j) {
      for (int i = 0; i < kCells; ++i) {
        const double value = answer(across.low + (across.high - across.low) * (i + 0.5) / kCells, up.low + (up.high - up.low) * (j + 0.5) / kCells);
        const double share = (value - output.low) / (output.high - output.low);
        // A little larger than its place, so that there are no visible seams.
        svg_.add("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", f.x + i * width,
                       f.y + f.height - (j + 1) * height, width + 0.3, height + 0.3, colour(share));
      }
    }
    svg_.add("</g>\n");
    draw_axes(f, axis_name(slot_name(c_, picture_.x), across.unit), true);
    svg_.add("<text transform=\"translate({:.1f},{:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", f.x - 52, f.y + f.height / 2,
                   axis_name(slot_name(c_, picture_.y), up.unit));
    draw_scale(output, f.x + f.width + 26, f.y, f.height);
  }

  void draw_scale(const fuzzy::Output& output, double x, double y, double height) {
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      svg_.add("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"18\" height=\"{:.2f}\" fill=\"{}\"/>\n", x, y + height * (kSteps - 1 - i) / kSteps,
                     height / kSteps + 0.3, colour((i + 0.5) / kSteps));
    }
    for (int i = 0; i <= 4; ++i) {
      svg_.text(x + 24, y + height - height * i / 4 + 4, "start", fmt::format("{:.4g}", output.low + (output.high - output.low) * i / 4));
    }
  }

  const fuzzy::Controller& c_;
  const FuzzyPicture& picture_;
  std::vector<Name> names_;   // of the terms of the input that is drawn
  Svg svg_;
};

}  // namespace

std::string print_fuzzy_svg(const fuzzy::Controller& controller, const FuzzyPicture& picture) { return Drawing(controller, picture).run(); }

}  // namespace kb::emit
