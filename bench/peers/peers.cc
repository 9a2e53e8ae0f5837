// The comparison with other ways to decide; prints JSON. bench/peers/run makes what it reads, runs it, and writes down what it says.
//
//   bench_peers PROGRAM.json IMAGE.kbt SOURCES FOLDER [ROUNDS]
//     PROGRAM.json, IMAGE.kbt   Route1 by `kbc dump program --json` and `kbc compile --emit image`
//     SOURCES                   the project's root, for its recorded facts
//     FOLDER                    of chain_RULES.kbt
#include <clips/constant.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/peers/measure.h"

int main(int argc, char** argv) try {
  if (argc < 5) {
    std::fputs("usage: bench_peers PROGRAM.json IMAGE.kbt SOURCES FOLDER [ROUNDS]\n", stderr);
    return 2;
  }
  nlohmann::json result;
  result["compiler"] = "g++ " __VERSION__;
  result["clips"] = VERSION_STRING;
  result["memory"] = peers::measure_memory();
  result["route1"] = peers::compare_route1(argv[1], argv[2], argv[3], argc > 5 ? std::atoi(argv[5]) : 200);
  result["sizes"] = peers::compare_sizes(argv[4], 60.0);
  std::cout << result.dump(1) << '\n';
  return std::cout ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_peers: %s\n", error.what());
  return 1;
}
