// Puts a helm that knows only quick robots of size 1 on any other. That helm must be given places of the small floor.
#pragma once

#include <memory>
#include <utility>

#include <waymark/controllers/similarity.h>
#include "sim/drive/helm.h"

namespace kb::sim::experiment {

class SizedHelm final : public Helm {
 public:
  SizedHelm(const mts::Similarity& as, std::unique_ptr<Helm> helm) : as_(as), helm_(std::move(helm)) {}

  void press(program::CellId fact, bool held) override { helm_->press(fact, held); }
  /// What tags say is passed on unchanged.
  [[nodiscard]] mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) override {
    return as_.out(helm_->step(now_us, as_.in(senses), tag, as_.in(dt_s, "s")));
  }
  [[nodiscard]] Judge::Belief belief() const override {
    Judge::Belief belief = helm_->belief();
    const double size = static_cast<double>(as_.of("m"));
    if (belief.place) belief.place = Spot{belief.place->x_m * size, belief.place->y_m * size};
    return belief;
  }
  [[nodiscard]] std::optional<bool> mission() const override { return helm_->mission(); }
  [[nodiscard]] const std::string& goal() const override { return helm_->goal(); }
  [[nodiscard]] std::vector<std::string> reports() const override { return helm_->reports(); }

 private:
  mts::Similarity as_;
  std::unique_ptr<Helm> helm_;
};

}  // namespace kb::sim::experiment
