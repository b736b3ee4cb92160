#!/usr/bin/env bash
# Trials of octant compare (compare.md).
#   compare.sh same OCTANT COUNT LOAD         COUNT comparisons of a program with itself beside LOAD busy programs
#   compare.sh delayed OCTANT CHECKOUT COUNT  COUNT comparisons with programs whose plan stage waits by 1, 2 and 5 %
# CHECKOUT: a copy of the checkout with a build in build/ci, whose session.cpp is changed. One line a comparison.
set -euo pipefail
what=$1 octant=$2
out=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$out"' EXIT

compared() { # label, new program, seed
  local code=0 answer
  answer=$("$octant" compare "$octant" "$2" --seed "$3" --out "$out/$3" --quiet | head -n 1) || code=$?
  echo "$1 | $code | $answer"
  rm -rf "${out:?}/$3"
}

case $what in
  same)
    for ((i = 0; i < $4; ++i)); do (while :; do :; done) & done
    for ((i = 1; i <= $3; ++i)); do compared "load $4" "$octant" "$i"; done
    ;;
  delayed)
    cd "$3"
    # Waits for so many milliseconds in the plan stage of frames 80 to 119.
    sed -i 's|^    record.plan_ms = stage.lap_ms();|    if (const char* wait_ms = std::getenv("WAIT_MS"); wait_ms != nullptr \&\& frame >= 80 \&\& frame < 120) {\n        for (const Stopwatch waiting; waiting.ms() < std::atof(wait_ms);) {}\n    }\n&|; s|^#include "ui/flight/session.h"|&\n#include <cstdlib>|' ui/flight/session.cpp
    cmake --build --preset ci --target octant >"$out/log" 2>&1 || { tail "$out/log"; exit 2; }
    frame_ms=$("$octant" fly turn --size 640x360 --frames 200 --json --quiet | sed -n 's/.*"mean_ms": *\([0-9.]*\).*/\1/p' | head -n 1)
    for percent in 1 2 5; do
      export WAIT_MS=$(awk "BEGIN { print $frame_ms * $percent / 100 * 190 / 40 }")
      for ((i = 1; i <= $4; ++i)); do compared "$percent %: $WAIT_MS ms in frames 80-119" "$3/build/ci/octant" "$i"; done
    done
    ;;
esac
