// What the pictures of fuzzy controllers and prototypes are drawn with.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compiler/source/utf8.h"

namespace kb::emit {

/// Dark enough on white, and distinct for readers who cannot tell red from green (Okabe and Ito, 2008).
inline constexpr std::string_view kBlue = "#0072b2", kVermilion = "#d55e00", kGreen = "#009e73", kPurple = "#cc79a7", kOrange = "#e69f00",
                                  kSky = "#56b4e9", kOlive = "#7f7f00", kBlack = "#000000";

/// A rectangle of the picture with axes of its own.
struct Frame {
  double x, y, width, height;
  double low, high;          // of the horizontal axis
  double bottom, top;        // of the vertical axis
  [[nodiscard]] double px(double v) const { return x + width * (v - low) / (high - low); }
  [[nodiscard]] double py(double v) const { return y + height * (top - v) / (top - bottom); }
};

/// The elements of a picture, in pixels, as they are added. Texts are taken as markup: escape plain text first.
class Svg {
 public:
  void text(double x, double y, std::string_view anchor, std::string_view markup, std::string_view colour = "#333333") {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", x, y, anchor, colour, markup);
  }
  void line(double x1, double y1, double x2, double y2, std::string_view colour) {
    add("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2, colour);
  }
  /// Points in the units of the frame's axes.
  void curve(const Frame& frame, const std::vector<std::pair<double, double>>& points, std::string_view colour) {
    add("<polyline fill=\"none\" stroke-width=\"2\" stroke=\"{}\" points=\"", colour);
    for (const auto& [x, y] : points) add("{:.1f},{:.1f} ", frame.px(x), frame.py(y));
    add("\"/>\n");
  }
  template <class... Args>
  void add(fmt::format_string<Args...> form, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), form, std::forward<Args>(args)...);
  }
  /// The whole picture with a title at (`left`, 24).
  [[nodiscard]] std::string picture(double width, double height, double left, std::string_view title) const {
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" font-family=\"sans-serif\" "
                       "font-size=\"12\">\n<title>{3}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
                       "<text x=\"{2}\" y=\"24\" font-size=\"16\" font-weight=\"bold\">{3}</text>\n{4}</svg>\n",
                       width, std::lround(height), left, source::escape_markup(title), out_);
  }

 private:
  std::string out_;
};

}  // namespace kb::emit
