#include "sim/batch/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "sim/batch/fields.h"

namespace kb::sim::batch {
namespace {

/// `# kbc fleet, batch 17, 2 runs, kbc 4, seeds 1-2`: each item is a name and, behind its last blank, a value; a number of runs says nothing.
std::vector<std::pair<std::string, std::string>> items_of(std::string_view comment) {
  std::vector<std::pair<std::string, std::string>> items;
  for (std::string_view item : source::split(comment, ',')) {
    while (item.starts_with(' ') || item.starts_with('#')) item.remove_prefix(1);
    const std::size_t blank = std::min(item.rfind(' '), item.size());
    if (item.empty() || item == "kbc fleet" || item.ends_with(" runs") || item.starts_with("batch ")) continue;
    items.emplace_back(item.substr(0, blank), item.substr(std::min(blank + 1, item.size())));
  }
  return items;
}

/// Where the columns stand that an Ending is made of.
struct Places {
  std::size_t outcome = 0, reports = 0, time = 0, length = 0, measures = 0;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::variant<Results, ResultsFault> read() {
    while (next() && fault_.what.empty()) {
      if (line_.starts_with('#')) {
        if (results_.made_of.empty()) results_.made_of = items_of(line_);
      } else if (columns_ == 0) {
        take_header();
      } else if (!line_.empty()) {
        take_row();
      }
    }
    if (fault_.what.empty() && columns_ == 0) refuse("there is no line with the names of columns");
    if (!fault_.what.empty()) return std::move(fault_);
    return std::move(results_);
  }

 private:
  bool next() {
    if (at_ >= text_.size()) return false;
    begin_ = at_;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    at_ = end + 1;
    return true;
  }
  void refuse(std::string what) {
    if (!fault_.what.empty()) return;
    fault_ = {begin_, begin_ + line_.size(), std::move(what)};
  }

  std::optional<std::size_t> column(const std::vector<std::string_view>& names, std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    refuse(fmt::format("there is no column `{}`", name));
    return std::nullopt;
  }

  void take_header() {
    const std::vector<std::string_view> names = source::split(line_, ','), measures = source::split(kMeasures, ',');
    const auto outcome = column(names, "outcome"), reports = column(names, "reports"), time = column(names, "time_s"), length = column(names, "length_m");
    if (!outcome || !reports || !time || !length) return;   // the first that is missing was told
    const auto found = std::search(names.begin(), names.end(), measures.begin(), measures.end());
    if (found == names.end()) return refuse(fmt::format("there are no columns `{}`", kMeasures));
    columns_ = names.size();
    places_ = {*outcome, *reports, *time, *length, static_cast<std::size_t>(found - names.begin())};
    const auto cut = names.begin() + static_cast<std::ptrdiff_t>(*outcome);
    results_.which.assign(names.begin(), cut);
    results_.measured.assign(cut, names.end());
    const auto noise = std::find(cut, names.end(), "noise");
    if (noise != names.end()) results_.noise = static_cast<std::size_t>(noise - cut);
  }

  void take_row() {
    const std::vector<std::string_view> fields = source::split(line_, ',');
    if (fields.size() != columns_) return refuse(fmt::format("{} fields stand here, and {} columns have a name", fields.size(), columns_));
    ResultRow row;
    std::size_t outcome = 0;
    const std::span<const std::string_view> all(fields);
    const bool good = read_name(fields[places_.outcome], kOutcomes, outcome) && source::read_number(fields[places_.time], row.ending.time_s) &&
                      source::read_number(fields[places_.length], row.ending.length_m) &&
                      read_measures(all.subspan(places_.measures).first<kMeasureCount>(), row.ending);
    if (!good) return refuse("this is no row of a run");
    row.ending.outcome = fields[places_.outcome];
    row.ending.reports = fields[places_.reports];
    const auto cut = static_cast<std::size_t>(fields[places_.outcome].data() - line_.data());
    row.which = line_.substr(0, cut == 0 ? 0 : cut - 1);
    row.measured = line_.substr(cut);
    results_.rows.push_back(std::move(row));
  }

  std::string_view text_, line_;
  std::size_t at_ = 0, begin_ = 0, columns_ = 0;
  Places places_;
  Results results_;
  ResultsFault fault_;
};

}  // namespace

std::string_view field(std::string_view fields, std::size_t number) {
  for (; number > 0; --number) fields.remove_prefix(std::min(fields.find(','), fields.size() - 1) + 1);
  return fields.substr(0, fields.find(','));
}

std::variant<Results, ResultsFault> read_results(std::string_view text) { return Reader(text).read(); }

}  // namespace kb::sim::batch
