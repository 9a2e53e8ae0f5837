#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <utility>

#include "bench/peers/measure.h"

namespace peers {

nlohmann::json measure_memory() {
  constexpr std::size_t kWords = (std::size_t{256} << 20) / sizeof(std::uint64_t), kLine = 8, kReads = 1'000'000;
  std::vector<std::uint64_t> memory(kWords);
  // One ring through a word of each cache line, in random order (Sattolo's shuffle).
  std::vector<std::uint32_t> lines(kWords / kLine);
  std::iota(lines.begin(), lines.end(), 0u);
  std::mt19937_64 random(1);
  for (std::size_t i = lines.size() - 1; i > 0; --i) std::swap(lines[i], lines[random() % i]);
  for (std::size_t i = 0; i < lines.size(); ++i) memory[kLine * i] = kLine * lines[i];
  double wait_ns = std::numeric_limits<double>::max(), all_ns = wait_ns;
  std::uint64_t at = 0;
  for (int round = 0; round < 5; ++round) {
    const auto begin = Clock::now();
    for (std::size_t i = 0; i < kReads; ++i) at = memory[at];
    keep(at);
    wait_ns = std::min(wait_ns, ns_since(begin) / kReads);
    const auto begin_all = Clock::now();
    keep(std::accumulate(memory.begin(), memory.end(), std::uint64_t{0}));
    all_ns = std::min(all_ns, ns_since(begin_all));
  }
  return {{"read_ns", wait_ns}, {"gb_per_s", static_cast<double>(kWords * sizeof(std::uint64_t)) / all_ns}};
}

}  // namespace peers
