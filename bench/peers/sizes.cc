// The chain in sizes of 10 to 10^6 rules.
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/peers/chain.h"
#include "bench/peers/measure.h"

namespace peers {
namespace {

constexpr std::uint32_t kSizes[] = {10, 100, 1'000, 10'000, 100'000, 1'000'000};
constexpr std::uint32_t kStretch = 1'000;   ///< legs that are driven again and again

/// Drives from the first leg over `legs` legs, and says what that took for a tick. Throws std::runtime_error if it does not
/// wait at each landmark and drive behind it.
double drive(ChainPeer& peer, std::uint32_t legs, std::uint32_t ring) {
  std::uint32_t wrong = 0;
  const auto begin = Clock::now();
  for (std::uint32_t l = 0; l < legs; ++l) {
    const std::uint32_t landmark = l < ring ? l : l % ring;
    peer.see(landmark, 0.9f);
    wrong += peer.tick();
    peer.see(landmark, -0.9f);
    wrong += !peer.tick();
  }
  const double ns = ns_since(begin);
  if (wrong != 0) throw std::runtime_error("a chain decides wrongly");
  peer.home();
  return ns / (2.0 * legs);
}

/// The least of many stretches. `stretch` shrinks for peers that need milliseconds a tick.
double time_of(ChainPeer& peer, std::uint32_t legs) {
  std::uint32_t stretch = std::min(legs, kStretch);
  const double first = drive(peer, std::min(stretch, 3u), legs);
  while (stretch > 10 && first * stretch > 0.1e9) stretch /= 10;
  double least = drive(peer, stretch, legs);
  const auto begin = Clock::now();
  for (int i = 0; i < 2'000 && (i < 5 || ns_since(begin) < 0.6e9); ++i) least = std::min(least, drive(peer, stretch, legs));
  return least;
}

}  // namespace

nlohmann::json compare_sizes(const std::string& folder, double patience_s) {
  struct Peer { const char* name; std::function<std::unique_ptr<ChainPeer>(std::uint32_t rules)> make; bool given_up = false; };
  Peer peers[] = {
      {"Waymark, image", [&](std::uint32_t rules) { return chain_by_image(folder + "/chain_" + std::to_string(rules) + ".kbt"); }},
      {"switch by hand", [](std::uint32_t rules) { return chain_by_switch(legs_for(rules)); }},
      {"linear scan", [](std::uint32_t rules) { return chain_by_scan(legs_for(rules)); }},
      {"behaviour tree by hand", [](std::uint32_t rules) { return chain_by_tree(legs_for(rules)); }},
      {"CLIPS", [&](std::uint32_t rules) { return chain_by_clips(legs_for(rules), patience_s); }}};
  nlohmann::json result = nlohmann::json::array();
  for (const std::uint32_t rules : kSizes) {
    const std::uint32_t legs = legs_for(rules);
    for (Peer& peer : peers) {
      if (peer.given_up) continue;
      const auto begin = Clock::now();
      const auto made = peer.make(rules);
      const double made_s = ns_since(begin) / 1e9;
      peer.given_up = made == nullptr || made_s > patience_s;
      if (made == nullptr) {
        result.push_back({{"name", peer.name}, {"rules", rules}, {"made_s", made_s}});   // without a time of a tick
        continue;
      }
      const double ns = time_of(*made, legs);
      result.push_back({{"name", peer.name}, {"rules", rules}, {"made_s", made_s}, {"ns", ns}});
      if (&peer == peers) result.back()["once_ns"] = drive(*made, legs, legs);
      std::fprintf(stderr, "%8u rules, %s: %.0f ns\n", rules, peer.name, ns);
    }
  }
  return result;
}

}  // namespace peers
