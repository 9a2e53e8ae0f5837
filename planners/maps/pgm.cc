// Reads PGM images, binary (P5) and plain (P2), as the occupancy of a ROS map.
#include <fmt/format.h>

#include <cmath>

#include "planners/maps/maps.h"

namespace kb::planners {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

struct Header {
  bool binary = true;
  std::int64_t width = 0, height = 0, most = 0;
};

class Pgm {
 public:
  Pgm(source::FileId file, Diagnostics& diagnostics)
      : bytes_(diagnostics.sources().bytes(file)), file_(file), diagnostics_(diagnostics) {}

  std::optional<Header> read_header() {
    Header header;
    if (!bytes_.starts_with("P5") && !bytes_.starts_with("P2")) {
      diagnostics_.report(Kind::kPgmMagic, span(0, std::min<std::size_t>(bytes_.size(), 2)));
      return std::nullopt;
    }
    header.binary = bytes_[1] == '5';
    at_ = 2;
    if (!read_number("the width", Grid::kMaxSide, header.width) || !read_number("the height", Grid::kMaxSide, header.height) ||
        !read_number("the value of white", 65535, header.most)) {
      return std::nullopt;
    }
    if (header.binary && at_ < bytes_.size() && !is_space(bytes_[at_])) {
      diagnostics_.report(Kind::kPgmNumber, span(at_, at_ + 1), {"a white space", "one, and then the pixels"});
      return std::nullopt;
    }
    ++at_;   // exactly one white space stands between the header and the pixels
    return header;
  }

  // Whether the file can hold the pixels that its header promises (reports if not); asked before memory is taken for them.
  bool long_enough(const Header& header) {
    const std::size_t pixels = static_cast<std::size_t>(header.width * header.height);
    const std::size_t left = bytes_.size() > at_ ? bytes_.size() - at_ : 0;
    const std::size_t need = header.binary ? pixels * (header.most > 255 ? 2 : 1) : pixels * 2 - 1;
    if (left >= need) return true;
    report_short(header, left == 1 ? "1 byte follows" : fmt::format("{} bytes follow", left));
    return false;
  }

  // Whether nothing follows the last pixel (reports if something does): otherwise the header most likely belongs to another image, and all
  // rows would be askew.
  bool at_end(const Header& header) {
    if (!header.binary) {
      skip_space();
    } else if (const auto rest = bytes_.substr(at_); rest == "\n" || rest == "\r\n") {   // added by an editor
      at_ = bytes_.size();
    }
    if (at_ == bytes_.size()) return true;
    diagnostics_.report(Kind::kPgmLong, span(at_, at_ + 1), {fmt::format("{}", header.width * header.height)});
    return false;
  }

  // `before`: how many pixels have been read.
  std::optional<std::int64_t> read_pixel(const Header& header, std::int64_t before) {
    if (!header.binary) {
      std::int64_t value = 0;
      skip_space();
      if (at_ == bytes_.size()) {
        report_short(header, before == 1 ? "1 pixel follows" : fmt::format("{} pixels follow", before));
        return std::nullopt;
      }
      return read_number("a pixel", header.most, value, 0) ? std::optional(value) : std::nullopt;
    }
    std::int64_t value = static_cast<unsigned char>(bytes_[at_++]);
    if (header.most > 255) value = value * 256 + static_cast<unsigned char>(bytes_[at_++]);
    if (value <= header.most) return value;
    diagnostics_.report(Kind::kPgmPixel, span(at_ - 1, at_), {fmt::format("{}", value), fmt::format("{}", header.most)});
    return std::nullopt;
  }

 private:
  source::Span span(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip_space() {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') at_ = std::min(bytes_.find_first_of("\r\n", at_), bytes_.size());
      else ++at_;
    }
  }
  bool read_number(std::string_view what, std::int64_t most, std::int64_t& value, std::int64_t least = 1) {
    skip_space();
    const std::size_t begin = at_;
    value = 0;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9' && value <= most) {
      value = value * 10 + (bytes_[at_++] - '0');
    }
    if (at_ > begin && value >= least && value <= most) return true;
    diagnostics_.report(Kind::kPgmNumber, span(begin, std::max(at_, std::min(begin + 1, bytes_.size()))),
                        {what, fmt::format("{} to {}", least, most)});
    return false;
  }
  void report_short(const Header& header, std::string_view what_follows) {
    diagnostics_.report(Kind::kPgmShort, span(bytes_.size(), bytes_.size()),
                        {fmt::format("{}", header.width * header.height), what_follows});
  }

  std::string_view bytes_;
  source::FileId file_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
};

// Whether map_server takes the pixel for a free cell. Raw pixels, scaled so that white is 255, are percent; above 100 they mean unknown.
bool is_free(std::int64_t pixel, std::int64_t white, const RosMap& map) {
  const double shade = static_cast<double>(pixel) / static_cast<double>(white), percent = std::round(shade * 255.0);
  const double occupied = map.raw ? percent / 100.0 : map.negate ? shade : 1.0 - shade;
  return occupied < map.free_thresh && occupied <= map.occupied_thresh;
}

}  // namespace

std::optional<Grid> read_pgm(source::FileId file, const RosMap& map, Diagnostics& diagnostics) {
  Pgm image(file, diagnostics);
  const auto header = image.read_header();
  if (!header || !image.long_enough(*header)) return std::nullopt;
  Grid grid(static_cast<std::int32_t>(header->width), static_cast<std::int32_t>(header->height), map.resolution_m,
            map.origin_m);
  for (std::int32_t row = 0; row < grid.height(); ++row) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      const auto pixel = image.read_pixel(*header, row * header->width + x);
      if (!pixel) return std::nullopt;
      if (!is_free(*pixel, header->most, map)) grid.set_blocked({x, grid.height() - 1 - row}, true);
    }
  }
  if (!image.at_end(*header)) return std::nullopt;
  return grid;
}

}  // namespace kb::planners
