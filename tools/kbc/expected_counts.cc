#include "tools/kbc/expected_counts.h"

#include "tools/kbc/support.h"

namespace kb::cli {

std::optional<std::vector<sim::batch::Demand>> expected_counts(const std::string& text, std::span<const std::string_view> names, Session& session) {
  if (text.empty()) return std::vector<sim::batch::Demand>();
  std::string why;
  auto read = sim::batch::read_demands(text, names, why);
  if (!read) session.report(diagnostics::Kind::kFleetExpect, {text, why});
  return read;
}

}  // namespace kb::cli
