// Tables to an image (.kbt) and back. The form is that of runtime/image_layout.h; docs/image.md describes it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <waymark/runtime/image.h>
#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// The image of a knowledge base: the same bytes for the same tables and names, on every machine. What an image cannot
/// carry (perception, fuzzy controllers) is left out. Empty if the image would exceed the largest size allowed. O(tables).
[[nodiscard]] std::string write_image(const Tables& tables, const program::Program& program);

/// The head of that image, without size and checksum. `name_bytes`: of all names, each with the zero that ends it.
[[nodiscard]] mts::ImageHead image_head(const Tables& tables, std::uint32_t name_bytes);

/// Verifies an image in place, as every reader does; `bytes` must be aligned like heap memory.
[[nodiscard]] mts::ImageStatus verify_image(std::string_view bytes);

/// An image in memory of its own, verified.
class LoadedImage {
 public:
  /// Copies the bytes to aligned memory and verifies them there.
  explicit LoadedImage(std::string_view bytes);
  LoadedImage(const LoadedImage&) = delete;
  LoadedImage& operator=(const LoadedImage&) = delete;

  [[nodiscard]] mts::ImageStatus status() const { return status_; }
  /// Only if the status is kOk.
  [[nodiscard]] const mts::ImageHead& head() const { return *reinterpret_cast<const mts::ImageHead*>(memory_.data()); }
  /// Calls `f` with the view, an mts::Image of 16 or 32 bits. Only if the status is kOk.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return narrow_ ? f(view16_) : f(view32_);
  }

 private:
  std::vector<std::uint64_t> memory_;
  std::size_t size_ = 0;
  mts::ImageStatus status_ = mts::ImageStatus::kTooShort;
  bool narrow_ = false;
  mts::Image<std::uint16_t> view16_;
  mts::Image<std::uint32_t> view32_;
};


/// The tables of an image as the compiler holds them.
[[nodiscard]] Tables recall_tables(const LoadedImage& image);
/// The core rules behind the tables, for explanations and for printing: they make the same decisions. What was lost in the tables
/// is not restored: small exclusive groups stay written out as effects, long conditions stay split, and files, places, sensors and
/// control lines are unknown. Fills in the conditions of `tables.origins`.
[[nodiscard]] program::Program recall_program(const LoadedImage& image, Tables& tables);

/// What an image holds, in names, one item a line: for `kbc dump image`.
[[nodiscard]] std::string print_image(const LoadedImage& image);

}  // namespace kb::tables
