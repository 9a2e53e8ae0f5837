// make_map: prints a city or a warehouse as a knowledge base.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/maps/road_map.h"

int main(int argc, char** argv) {
  using namespace kb::bench;
  std::uint32_t roads = 100, legs = 100;
  std::uint64_t seed = 1;
  std::string kind = "city";
  CLI::App app("Prints a map with so many roads, a rule for each road and direction, and a tour, as a knowledge base.");
  app.add_option("--roads", roads, "How many roads")->check(CLI::Range(kFewestRoads, 10'000'000u))->capture_default_str();
  app.add_option("--kind", kind, "What it is a map of")->check(CLI::IsMember({"city", "warehouse"}))->capture_default_str();
  app.add_option("--legs", legs, "How many roads the tour takes")->check(CLI::Range(1u, 100'000u))->capture_default_str();
  app.add_option("--seed", seed, "The same seed gives the same map")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const RoadMap map = kind == "city" ? make_city(roads, seed) : make_warehouse(roads, seed);
  const std::string text = kb_text(map, make_tour(map, legs, seed));
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return 0;
  std::perror("make_map: cannot write the map");
  return 1;
}
