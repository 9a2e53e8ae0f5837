// The chain by its image, by a scan over all rules, and by a behaviour tree.
#include "bench/peers/chain.h"

#include <algorithm>
#include <fstream>
#include <random>
#include <stdexcept>
#include <vector>

#include <waymark/runtime/image_mind.h>
#include "bench/peers/behavior_tree.h"

namespace peers {
namespace {

class ByImage final : public ChainPeer {
 public:
  explicit ByImage(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw std::runtime_error("cannot read " + path);
    const auto size = static_cast<std::size_t>(file.tellg());
    image_.resize(size / 8 + 1);
    file.seekg(0);
    file.read(reinterpret_cast<char*>(image_.data()), static_cast<std::streamsize>(size));
    mts::ImageInfo info;
    if (mts::peek_image(image_.data(), size, info) != mts::ImageStatus::kOk) throw std::runtime_error(path + " is no image");
    block_.resize(info.state_bytes / 8 + 1);
    mts::SwapReport report;
    if (mind_.take(image_.data(), size, reinterpret_cast<std::byte*>(block_.data()), 8 * block_.size(), report, [](const auto&) {}) != mts::ImageStatus::kOk) {
      throw std::runtime_error(path + " is refused");
    }
    if (mind_.find(mts::ImageKind::kFact, "L0") != 0) throw std::runtime_error(path + " is no chain");
    home_ = mind_.find(mts::ImageKind::kFact, "Home");
    drive_ = mind_.find(mts::ImageKind::kStrategy, "Drive");
    mind_.tick(mts::milliseconds(0));
  }
  void see(std::uint32_t landmark, float value) override { mind_.set_fact(landmark, value); }
  bool tick() override {
    mind_.tick(mts::milliseconds(20));
    return mind_.drives() && mind_.strategy() == drive_;
  }
  void home() override {
    for (const float value : {1.0f, -1.0f}) {
      mind_.set_fact(home_, value);
      mind_.tick(mts::milliseconds(20));
    }
  }

 private:
  std::vector<std::uint64_t> image_, block_;
  mts::ImageMind mind_;
  std::uint32_t home_ = 0, drive_ = 0;
};

class ByScan final : public ChainPeer {
 public:
  explicit ByScan(std::uint32_t legs) : truth_(4u + 4u * std::size_t{legs}) {
    for (std::uint32_t l = 0; l < legs; ++l) {
      const std::uint32_t from = (l + legs - 1) % legs, next = (l + 1) % legs;
      rules_.push_back({{at_leg(l), kLooking, seen(l)}, next, kArrived});
      rules_.push_back({{at_leg(l), kArrived, seen(from) + 1}, l, kLooking});
    }
    for (std::uint32_t l = 0; l < legs; ++l) truth_[seen(l) + 1] = 1;
    home();
  }
  void see(std::uint32_t landmark, float value) override {
    const bool lower = landmark == leg_ || truth_[seen(landmark)] != 0, now = value > (lower ? 0.5f : 0.75f);
    truth_[seen(landmark)] = now;
    truth_[seen(landmark) + 1] = !now;
  }
  bool tick() override {
    std::size_t fired = rules_.size();
    for (std::size_t r = 0; r < rules_.size(); ++r) {
      const Rule& rule = rules_[r];
      if ((truth_[rule.needs[0]] & truth_[rule.needs[1]] & truth_[rule.needs[2]]) != 0) fired = r;
    }
    if (fired != rules_.size()) move_to(rules_[fired].leg, rules_[fired].watch);
    return truth_[kLooking] != 0;
  }
  void home() override { move_to(0, kLooking); }

 private:
  enum : std::uint32_t { kLooking, kArrived };
  struct Rule { std::uint32_t needs[3], leg, watch; };
  static std::uint32_t at_leg(std::uint32_t leg) { return 4 + 4 * leg; }
  static std::uint32_t seen(std::uint32_t landmark) { return 6 + 4 * landmark; }   // and after it: not seen
  void move_to(std::uint32_t leg, std::uint32_t watch) {
    truth_[at_leg(leg_)] = 0;
    leg_ = leg;
    truth_[at_leg(leg_)] = 1;
    truth_[kLooking] = watch == kLooking;
    truth_[kArrived] = watch == kArrived;
  }

  std::uint32_t leg_ = 0;
  std::vector<std::uint8_t> truth_;
  std::vector<Rule> rules_;
};

class ByTree final : public ChainPeer {
 public:
  explicit ByTree(std::uint32_t legs) : views_(legs) {
    std::vector<tree::NodePtr> rules;
    for (std::uint32_t l = 0; l < legs; ++l) {
      const std::uint32_t from = (l + legs - 1) % legs, next = (l + 1) % legs;
      rules.push_back(tree::sequence(tree::when([this, l] { return leg_ == l; }), tree::when([this] { return looking_; }),
                                     tree::when([this, l] { return views_[l]; }), tree::act([this, next] {
                                       leg_ = next;
                                       looking_ = false;
                                     })));
      rules.push_back(tree::sequence(tree::when([this, l] { return leg_ == l; }), tree::when([this] { return !looking_; }),
                                     tree::when([this, from] { return !views_[from]; }), tree::act([this] { looking_ = true; })));
    }
    std::shuffle(rules.begin(), rules.end(), std::mt19937(1));   // or the first legs, which are driven, would be found first
    root_ = std::make_unique<tree::Fallback>(std::move(rules));
  }
  void see(std::uint32_t landmark, float value) override { views_.see(landmark, value, leg_); }
  bool tick() override {
    (void)root_->tick();
    return looking_;
  }
  void home() override {
    leg_ = 0;
    looking_ = true;
  }

 private:
  Views views_;
  std::uint32_t leg_ = 0;
  bool looking_ = true;
  tree::NodePtr root_;
};

}  // namespace

std::unique_ptr<ChainPeer> chain_by_image(const std::string& path) {
  auto peer = std::make_unique<ByImage>(path);
  peer->home();
  return peer;
}
std::unique_ptr<ChainPeer> chain_by_scan(std::uint32_t legs) { return std::make_unique<ByScan>(legs); }
std::unique_ptr<ChainPeer> chain_by_tree(std::uint32_t legs) { return std::make_unique<ByTree>(legs); }

}  // namespace peers
