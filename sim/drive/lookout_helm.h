// At the wheel: what a C++ program consists of that drives by a compiled knowledge base. `mts::Lookout` perceives, the mind decides, `mts::Pilot` drives.
// They know roads by the map (`kbc compile --map`), not by what tags remember, and otherwise do what the simulator's own driver does.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <waymark/controllers/lookout.h>
#include "sim/drive/helm.h"
#include "sim/mind/map_roads.h"

namespace kb::sim {

/// The facts of a knowledge base that is known only now, as `mts::Lookout` wants them.
struct ProgramFacts {
  using Facts = std::vector<float>;
  using FindRoad = std::function<const mts::MapRoad*(const char* landmark, const char* exit)>;
  const std::vector<std::string>* names = nullptr;

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(names->size()); }
  [[nodiscard]] const char* name_of(std::uint32_t fact) const { return (*names)[fact].c_str(); }
  [[nodiscard]] static float get(const Facts& facts, std::uint32_t fact) { return facts[fact]; }
  static void set(Facts& facts, std::uint32_t fact, float certainty) { facts[fact] = certainty; }
};

class LookoutHelm final : public Helm {
 public:
  /// `knowledge` and `roads` must outlive it. `body`: see as_driven. `dt_us`: of the mind, a multiple of kControlUs.
  LookoutHelm(const Knowledge& knowledge, const MapRoads& roads, const mts::Body& body, std::uint32_t dt_us);
  LookoutHelm(const LookoutHelm&) = delete;

  std::function<void(const program::Tick&)> on_tick;

  void press(program::CellId fact, bool held) override;
  void release(program::CellId fact) override;
  [[nodiscard]] mts::Motion step(std::int64_t now_us, const mts::Senses& senses, const TagHeard& tag, float dt_s) override;
  [[nodiscard]] Judge::Belief belief() const override;
  [[nodiscard]] std::optional<bool> mission() const override;
  [[nodiscard]] const std::string& goal() const override { return goal_; }
  [[nodiscard]] std::vector<std::string> reports() const override;
  [[nodiscard]] bool high(program::CellId cell) const override { return machine_.value(cell) >= firing_; }
  [[nodiscard]] bool seen(program::CellId fact) const override { return machine_.seen(fact); }
  [[nodiscard]] bool sees() const override { return true; }

 private:
  struct Line {
    std::vector<mts::ControlArgument> arguments;
    mts::ControlLine line{};
  };
  struct Button { program::CellId fact{}; int ticks = 0; };

  void add_line(const Strategy& strategy);
  void read(const TagHeard& tag);
  void tick();

  const Knowledge* knowledge_;
  const MapRoads* roads_;
  std::vector<std::string> names_;            // of the facts
  std::vector<Line> lines_;                   // by strategy
  std::vector<mts::FactRun> landmarks_;
  mts::Pilot pilot_;
  mts::Lookout<program::Program, ProgramFacts> lookout_;
  tables::Machine machine_;
  std::vector<float> facts_;
  std::vector<Button> pressed_;
  mts::Sign sign_;
  std::string closed_, cross_by_;             // what the sign says
  std::uint32_t dt_us_;
  float firing_;
  int strategy_ = -1;
  std::string goal_;                          // none of its own: the leg tells it
};

}  // namespace kb::sim
