// A knowledge base of any size in every form: a chain of landmarks that closes to a ring, two rules a leg.
//
//   rule arrive[l in Leg]   when seen l.to and l and Looking             then +l.next, +Arrived
//   rule look_out[l in Leg] when l and Arrived and not seen l.from       then +Looking
//
// The landmark comes into view: it has arrived, and waits. The landmark goes out of view: it looks for the next, and drives.
// So each tick is an event that fires one rule and changes the strategy, and all rules of a kind share a condition, as the
// rules of real knowledge bases do. bench/peers/run writes the same as .kb.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace peers {

/// A mind for the chain.
class ChainPeer {
 public:
  ChainPeer() = default;
  ChainPeer(const ChainPeer&) = delete;
  ChainPeer& operator=(const ChainPeer&) = delete;
  virtual ~ChainPeer() = default;
  /// The certainty of a landmark, on the next tick.
  virtual void see(std::uint32_t landmark, float value) = 0;
  /// Whether it drives; else it waits.
  virtual bool tick() = 0;
  /// Back to the first leg, as at start-up with the command given.
  virtual void home() = 0;
};

/// How many legs make about so many rules.
[[nodiscard]] constexpr std::uint32_t legs_for(std::uint32_t rules) { return (rules - 3) / 2; }

/// By the image. Throws std::runtime_error if it cannot be taken.
[[nodiscard]] std::unique_ptr<ChainPeer> chain_by_image(const std::string& path);
/// A bare loop over all rules: three truth bits each, the shortest form there is.
[[nodiscard]] std::unique_ptr<ChainPeer> chain_by_scan(std::uint32_t legs);
/// A fallback over all rules, each a sequence of conditions and an action.
[[nodiscard]] std::unique_ptr<ChainPeer> chain_by_tree(std::uint32_t legs);
/// Null if CLIPS is not done with making the rules after `patience_s`.
[[nodiscard]] std::unique_ptr<ChainPeer> chain_by_clips(std::uint32_t legs, double patience_s);
/// One case a leg, as make_switch.py writes it; null for sizes that it did not write.
[[nodiscard]] std::unique_ptr<ChainPeer> chain_by_switch(std::uint32_t legs);

/// What a mind by hand knows of the landmarks: which are in view, noticed sooner if looked for.
class Views {
 public:
  explicit Views(std::uint32_t landmarks) : seen_(std::make_unique<std::uint8_t[]>(landmarks)) {}
  void see(std::uint32_t landmark, float value, std::uint32_t looked_for) {
    const bool lower = landmark == looked_for || seen_[landmark] != 0;
    seen_[landmark] = value > (lower ? 0.5f : 0.75f);
  }
  [[nodiscard]] bool operator[](std::uint32_t landmark) const { return seen_[landmark] != 0; }

 private:
  std::unique_ptr<std::uint8_t[]> seen_;
};

}  // namespace peers
