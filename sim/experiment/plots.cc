// Draws the pictures of the experiment, in the style of planners/report: sans-serif on white, SVG written by hand, nothing random.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/experiment/summary.h"

namespace kb::sim::experiment {
namespace {

// Okabe and Ito's colours: people who cannot tell red from green can tell these apart.
constexpr std::array<std::string_view, 7> kLineColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::array<std::string_view, 4> kDashes{"", "7 4", "2 3", "8 3 2 3"};

std::string begin(double width, double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
}

std::string words(double x, double y, std::string_view text, std::string_view anchor = "start", std::string_view weight = "normal") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-weight=\"{}\">{}</text>\n", x, y, anchor, weight, text);
}

/// The colour and the dash of the n-th curve.
std::string stroke(std::size_t n) {
  return fmt::format("stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{}\"", kLineColours[n % kLineColours.size()], kDashes[n % kDashes.size()]);
}

constexpr std::string_view kHatches = R"(<defs>
<pattern id="why" width="6" height="6" patternUnits="userSpaceOnUse"><rect width="6" height="6" fill="#f0e442"/><path d="M0 6L6 0" stroke="#7a7000"/></pattern>
<pattern id="silent" width="6" height="6" patternUnits="userSpaceOnUse"><rect width="6" height="6" fill="#d55e00"/><circle cx="3" cy="3" r="1.2" fill="#fff"/></pattern>
</defs>
)";

}  // namespace

std::string draw_outcomes(const std::vector<Share>& shares, const Combinations& set) {
  constexpr double kLeft = 150.0, kWide = 440.0, kBar = 18.0, kStep = 24.0, kGap = 14.0, kTop = 52.0;
  const double height = kTop + static_cast<double>(shares.size()) * kStep + static_cast<double>(kClassNames.size()) * kGap + 30.0;
  std::string out = begin(kLeft + kWide + 30.0, height);
  out += kHatches;
  const std::array<std::pair<std::string_view, std::string_view>, 3> keys{{{"#0072b2", "arrives"}, {"url(#why)", "stops and says why"}, {"url(#silent)", "neither"}}};
  double x = kLeft;
  for (const auto& [fill, text] : keys) {
    out += fmt::format("<rect x=\"{:.1f}\" y=\"14\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"#333\"/>\n", x, fill) + words(x + 20.0, 26.0, text);
    x += 150.0;
  }
  double y = kTop;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Share& s = shares[i];
    if (i == 0 || shares[i - 1].what != s.what) {
      if (i > 0) y += kGap;
      out += words(8.0, y + kBar - 5.0, kClassNames[static_cast<std::size_t>(s.what)], "start", "bold");
    }
    out += words(kLeft - 8.0, y + kBar - 5.0, label(s.method, set[s.set]), "end");
    double at = kLeft;
    for (const auto& [fill, count] : {std::pair{keys[0].first, s.arrived}, std::pair{keys[1].first, s.says_why}, std::pair{keys[2].first, s.silent}}) {
      const double wide = s.runs == 0 ? 0.0 : kWide * static_cast<double>(count) / static_cast<double>(s.runs);
      if (wide > 0.0) out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.0f}\" fill=\"{}\" stroke=\"#333\" stroke-width=\"0.6\"/>\n", at, y, wide, kBar, fill);
      at += wide;
    }
    y += kStep;
  }
  for (int tick = 0; tick <= 100; tick += 25) out += words(kLeft + kWide * tick / 100.0, y + 16.0, fmt::format("{} %", tick), "middle");
  return out + "</svg>\n";
}

namespace {

constexpr double kWide = 300.0, kHigh = 170.0, kBelow = 62.0, kMost = 6.0;   // of a picture of times; kMost: times the shortest time

/// The axes of a class; `left` and `top` are their upper left corner.
std::string axes(double left, double top, std::string_view name) {
  std::string out = words(left, top - 8.0, name, "start", "bold");
  out += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"none\" stroke=\"#999\"/>\n", left, top, kWide, kHigh);
  for (int percent = 0; percent <= 100; percent += 50) out += words(left - 4.0, top + kHigh * (1.0 - percent / 100.0) + 4.0, fmt::format("{}", percent), "end");
  for (int times = 1; times <= 6; ++times) out += words(left + kWide * (times - 1) / (kMost - 1.0), top + kHigh + 16.0, fmt::format("{}", times), "middle");
  return out;
}

std::string curve(double left, double top, const Share& share, std::string_view look) {
  std::vector<double> ratios = share.times;
  std::sort(ratios.begin(), ratios.end());
  std::string path = fmt::format("M{:.1f} {:.1f}", left, top + kHigh);
  for (std::size_t i = 0; i < ratios.size() && ratios[i] < kMost; ++i) {
    const double x = left + kWide * std::max(ratios[i] - 1.0, 0.0) / (kMost - 1.0);
    path += fmt::format("H{:.1f}V{:.1f}", x, top + kHigh * (1.0 - static_cast<double>(i + 1) / static_cast<double>(share.runs)));
  }
  return fmt::format("<path d=\"{}H{:.1f}\" fill=\"none\" {}/>\n", path, left + kWide, look);
}

}  // namespace

std::string draw_times(const std::vector<Share>& shares, const Combinations& set) {
  constexpr double kMargin = 46.0;
  constexpr std::size_t kKeys = 5;   // side by side
  const std::size_t ways = shares.size() / kClassNames.size();
  const double keys_high = 18.0 * static_cast<double>((std::max<std::size_t>(ways, 1) - 1) / kKeys);
  std::string out = begin(2.0 * (kWide + kMargin) + 20.0, 2.0 * (kHigh + kBelow) + 34.0 + keys_high);
  for (std::size_t m = 0; m < ways; ++m) {
    const double key_x = kMargin + 130.0 * static_cast<double>(m % kKeys), key_y = 16.0 + 18.0 * static_cast<double>(m / kKeys);
    out += fmt::format("<path d=\"M{:.0f} {:.0f}h30\" {}/>\n", key_x, key_y, stroke(m)) + words(key_x + 36.0, key_y + 4.0, label(shares[m].method, set[shares[m].set]));
  }
  for (std::size_t c = 0; c < kClassNames.size(); ++c) {
    const double left = kMargin + static_cast<double>(c % 2) * (kWide + kMargin), top = 56.0 + keys_high + static_cast<double>(c / 2) * (kHigh + kBelow);
    out += axes(left, top, kClassNames[c]);
    for (std::size_t m = 0; m < ways; ++m) out += curve(left, top, shares[c * ways + m], stroke(m));
  }
  out += words(kMargin, 2.0 * (kHigh + kBelow) + 26.0 + keys_high, "% of the runs that arrived within so many times the shortest possible time");
  return out + "</svg>\n";
}

}  // namespace kb::sim::experiment
