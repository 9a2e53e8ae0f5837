#!/usr/bin/env bash
# Installs what is missing and runs every test of the project. On a fresh Debian 12, as root or with sudo, nothing else is
# needed. 14 to 25 minutes on two cores, depending on the machine.
#
#   ./test.sh                 all steps, those that fail fast first
#   ./test.sh checks demo     only these; what they need must have been built
#   ./test.sh --list          the names of the steps
#
# What the steps print goes to build/logs/STEP.log. The last line says `N passed, N failed`; the exit code is 0 if and
# only if nothing failed.
set -uo pipefail
cd "$(dirname "$0")" || exit 1
export CTEST_OUTPUT_ON_FAILURE=1 CTEST_PARALLEL_LEVEL
CTEST_PARALLEL_LEVEL=$(($(nproc) + 1))   # some wait for a browser or a network
if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
unset WAYMARK_LIBRARY
built=build/test
sanitized=build/asan-ubsan

# ---- the steps, in order; each is a function of this name ------------------------------------------------------------
steps=(packages checks build tests demo freestanding sanitized sanitized_tests same_bytes)

packages() {
  tools/install_packages build test page
}
checks() {          # what needs no compiler
  tools/check_layers && tools/check_includes && tools/check_notes && tools/check_abi && tools/check_times && python3 tests/golden/coverage.py
}
build() {           # g++, optimised, -Werror
  cmake --preset test && cmake --build --preset test
}
tests() {           # unit tests, golden tests, the table, closed loops, equivalence, install, what must not compile, ...
  ctest --test-dir $built --no-tests=error
}
demo() {            # what a visitor sees
  ./demo.sh >build/logs/demo.out && grep -q '542 of the 544 cells that the mind computes agree' build/logs/demo.out
}
freestanding() {    # the runtime without a standard library; the kbc of the build
  cmake --preset freestanding -DWAYMARK_BUILD_COMPILER=OFF -DWAYMARK_KBC="$PWD/$built/bin/kbc" &&
    cmake --build --preset freestanding && ctest --preset freestanding --no-tests=error
}
sanitized() {       # clang++, -Werror, address and undefined-behaviour sanitizers
  # No lines in traces, which takes a tenth off; each memory access is checked by a call, not by code in its place, a fifth.
  cmake --preset asan-ubsan -DCMAKE_CXX_COMPILER=clang++ -DWAYMARK_WERROR=ON -DWAYMARK_BUILD_EXAMPLES=OFF -DWAYMARK_TEST_ONCE=ON \
    "-DCMAKE_CXX_FLAGS_DEBUG=-O0 -mllvm -asan-instrumentation-with-call-threshold=0" &&
    cmake --build --preset asan-ubsan
}
sanitized_tests() { # the whole compiler and the runtime on golden cases, unit tests and the fuzz corpus
  # (long golden cases, long unit tests and the examples of the explanations have been run in `tests`; the example of four million
  # rules would take ten minutes here)
  ctest --preset asan-ubsan --no-tests=error --timeout 3600 -E '^(golden.explanations|equivalence.*|docs.*|layout.*)$'
}
same_bytes() {      # two builds, two folders, two locales, two time zones
  tools/check_same_bytes $built/bin/kbc $sanitized/bin/kbc
}

# ---- running them ----------------------------------------------------------------------------------------------------
# What there is to see of a step that failed: what its failed tests printed, or else its last lines.
explain() {         # log
  local printed
  printed=$(awk '
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { shown = /\*\*\*/ && !/\*\*\*Skipped/ }
    /^ +Start +[0-9]+: / || /% tests passed, / { shown = 0 }
    shown' "$1" | tail -n 100)
  sed 's/^/        /' <<<"${printed:-$(tail -n 60 "$1")}"
}
# Counts what a step has run: the tests of ctest, else the step itself.
count() {           # log, exit code -> passed, failed
  awk -v code="$2" '
    /tests passed, [0-9]+ tests failed out of/ { failed += $4; passed += $NF - $4; seen = 1 }
    END {
      if (!seen) { passed = code == 0; failed = code != 0 }
      else if (code != 0 && failed == 0) failed = 1
      print passed, failed
    }' "$1"
}

main() {
  if [ "${1-}" = --list ]; then printf '%s\n' "${steps[@]}"; return 0; fi
  local chosen=("$@") passed=0 failed=0 number=0 step code begin p f bad=()
  if [ $# -eq 0 ]; then chosen=("${steps[@]}"); fi
  if ! mkdir -p build/logs || ! [ -w build/logs ]; then echo "cannot write into build/logs, where the steps print to"; return 1; fi
  for step in "${chosen[@]}"; do
    case " ${steps[*]} " in *" $step "*) ;; *) echo "there is no step $step; --list names them"; return 2 ;; esac
    number=$((number + 1)) begin=$SECONDS
    printf '[%2d/%d] %-16s ' $number ${#chosen[@]} "$step"
    "$step" >"build/logs/$step.log" 2>&1 </dev/null
    code=$?
    read -r p f < <(count "build/logs/$step.log" $code) || p=0 f=1   # no log, as on a full disk: nothing is known to have passed
    passed=$((passed + p)) failed=$((failed + f))
    if [ "$f" -eq 0 ]; then
      printf 'passed %5d s  %4d tests\n' $((SECONDS - begin)) "$p"
    else
      printf 'FAILED %5d s  %4d of %d tests\n' $((SECONDS - begin)) "$f" $((p + f))
      bad+=("$step")
    fi
  done
  echo
  for step in ${bad[@]+"${bad[@]}"}; do echo "failed: $step, see build/logs/$step.log" && explain "build/logs/$step.log"; done
  echo "total time $((SECONDS / 60)) min $((SECONDS % 60)) s"
  echo "$passed passed, $failed failed"
  [ $failed -eq 0 ]
}
main "$@"
