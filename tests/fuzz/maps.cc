// Any bytes as a map, a scenario file, the YAML of a ROS map and a PGM image; the first byte says which. A map that is read is
// asked for a plan: what the readers let through must be safe for the planners.
#include <cstdint>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "planners/maps/maps.h"
#include "planners/method.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kb;
  if (size == 0) return 0;
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages(sources, consumer);
  std::optional<planners::Grid> grid;
  const auto file = sources.add("fuzz", std::move(bytes));
  switch (data[0]) {
    case 'v': static_cast<void>(planners::read_scenarios(file, planners::Grid(8, 8), messages)); break;
    case 'i': static_cast<void>(planners::read_ros_yaml(file, messages)); break;
    case 'P': {
      planners::RosMap map;
      map.resolution_m = 0.05;
      grid = planners::read_pgm(file, map, messages);
      break;
    }
    default: grid = planners::read_movingai_map(file, messages);
  }
  if (!grid || grid->free_cells() == 0 || grid->free_cells() > 4096) return 0;
  planners::Problem problem;
  problem.grid = &*grid;
  problem.start = grid->centre({0, 0});
  problem.goal = grid->centre({grid->width() - 1, grid->height() - 1});
  static_cast<void>(plan(*planners::find_method("neural"), problem));
  static_cast<void>(plan(*planners::find_method("fairway"), problem));
  return 0;
}
