#!/usr/bin/env bash
# The experiment of Kargin and Ivaniuk, from the knowledge base in examples/01_route1 to the decision of every tick:
# builds kbc, compiles the knowledge base to C++ tables, links them with the runtime, feeds the sensor facts of the paper's
# Table 1, and prints the table that comes out beside the paper's. Installs what is missing first.
set -euo pipefail
cd "$(dirname "$0")"
mkdir -p build/logs
quietly() {
  local log=build/logs/demo_build.log
  : >"$log"   # ends here if it cannot be written
  if ! "$@" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    exit 1
  fi
}
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi

echo "1. building kbc and the example (a few minutes the first time)" >&2
tools/install_packages build >&2
build=build/demo
if [ -e build/test/bin/kbc ]; then build=build/test   # what ./test.sh has built serves as well
else quietly cmake --preset test -B $build -DWAYMARK_BUILD_TESTS=OFF -DWAYMARK_WERROR=OFF   # the preset that is built fastest
fi
quietly cmake --build $build --target example_route1
echo "2. examples/01_route1/paper.kb -> C++ tables -> a mind -> the facts of Table 1" >&2
echo >&2
exec $build/examples/01_route1/example_route1
