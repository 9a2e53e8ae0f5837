// The chain in CLIPS, in the form of clips_program.h: a template for each thing that is asked, the leg first in each rule.
#include <string>
#include <vector>

#include "bench/peers/chain.h"
#include "bench/peers/clips_fact.h"
#include "bench/peers/measure.h"

extern "C" {
#include <clips/clips.h>
}

namespace peers {
namespace {

class ByClips final : public ChainPeer {
 public:
  explicit ByClips(std::uint32_t legs) : legs_(legs), views_(legs), environment_(CreateEnvironment()) {
    SetEnvironmentContext(environment_, this);
    EnvDefineFunction2(environment_, "move", 'v', PTIEF call_move, "call_move", "22i");
    EnvDefineFunction2(environment_, "run-it", 'v', PTIEF call_run, "call_run", "11i");
  }
  ~ByClips() override { DestroyEnvironment(environment_); }

  bool make(double patience_s) {
    const auto begin = Clock::now();
    for (const char* text : {"(deftemplate Looking)", "(deftemplate Arrived)", "(deftemplate tick)"}) EnvBuild(environment_, text);
    for (std::uint32_t l = 0; l < legs_; ++l) {
      const std::string leg = std::to_string(l);
      EnvBuild(environment_, ("(deftemplate leg-" + leg + ")").c_str());
      EnvBuild(environment_, ("(deftemplate seen-" + leg + ")").c_str());
      if (ns_since(begin) > patience_s * 1e9) return false;
    }
    for (std::uint32_t l = 0; l < legs_; ++l) {
      const std::string leg = std::to_string(l), from = std::to_string((l + legs_ - 1) % legs_), next = std::to_string((l + 1) % legs_);
      EnvBuild(environment_, ("(defrule arrive-" + leg + " (leg-" + leg + ") (Looking) (seen-" + leg + ") => (move " + next + " 0))").c_str());
      EnvBuild(environment_, ("(defrule look-" + leg + " (leg-" + leg + ") (Arrived) (not (seen-" + from + ")) => (move " + leg + " 1))").c_str());
      if (ns_since(begin) > patience_s * 1e9) return false;
    }
    EnvBuild(environment_, "(defrule run-Drive (declare (salience -1)) (Looking) (tick) => (run-it 1))");
    EnvBuild(environment_, "(defrule run-Wait (declare (salience -1)) (Arrived) (tick) => (run-it 0))");
    EnvReset(environment_);
    find_templates();
    home();
    return true;
  }

  void see(std::uint32_t landmark, float value) override {
    const bool before = views_[landmark];
    views_.see(landmark, value, leg_);
    if (views_[landmark] != before) seen_[landmark].stand(environment_, !before);
  }
  bool tick() override {
    if (tick_.fact != nullptr) tick_.stand(environment_, false);
    tick_.stand(environment_, true);
    EnvRun(environment_, -1);
    return drives_;
  }
  void home() override { move(0, true); }

  void move(std::uint32_t leg, bool looking) {
    if (leg != leg_ || at_leg_[leg].fact == nullptr) {
      at_leg_[leg_].stand(environment_, false);
      leg_ = leg;
      at_leg_[leg_].stand(environment_, true);
    }
    arrived_.stand(environment_, !looking);
    looking_.stand(environment_, looking);
  }
  void run(bool drives) { drives_ = drives; }

 private:
  static ByClips& peer_of(void* environment) { return *static_cast<ByClips*>(GetEnvironmentContext(environment)); }
  static void call_move(void* e) { peer_of(e).move(static_cast<std::uint32_t>(EnvRtnLong(e, 1)), EnvRtnLong(e, 2) != 0); }
  static void call_run(void* e) { peer_of(e).run(EnvRtnLong(e, 1) != 0); }

  void find_templates() {
    looking_.of_template = EnvFindDeftemplate(environment_, "Looking");
    arrived_.of_template = EnvFindDeftemplate(environment_, "Arrived");
    tick_.of_template = EnvFindDeftemplate(environment_, "tick");
    at_leg_.resize(legs_);
    seen_.resize(legs_);
    // CLIPS finds a name by looking through all of them: so one by one in the order in which they were made.
    std::uint32_t legs = 0, views = 0;
    for (void* t = EnvGetNextDeftemplate(environment_, nullptr); t != nullptr; t = EnvGetNextDeftemplate(environment_, t)) {
      const std::string name = EnvGetDeftemplateName(environment_, t);
      if (name.starts_with("leg-")) at_leg_[legs++].of_template = t;
      if (name.starts_with("seen-")) seen_[views++].of_template = t;
    }
  }

  std::uint32_t legs_, leg_ = 0;
  bool drives_ = true;
  Views views_;
  void* environment_;
  ClipsFact looking_, arrived_, tick_;
  std::vector<ClipsFact> at_leg_, seen_;
};

}  // namespace

std::unique_ptr<ChainPeer> chain_by_clips(std::uint32_t legs, double patience_s) {
  auto peer = std::make_unique<ByClips>(legs);
  if (!peer->make(patience_s)) return nullptr;
  return peer;
}

}  // namespace peers
