#!/usr/bin/env bash
# Trials of octant compare (comparison.md), a line each.
#   compare.sh same OCTANT COUNT LOAD      COUNT comparisons of a program with itself beside LOAD busy programs
#   compare.sh delayed OCTANT COUNT US...  COUNT comparisons each with a program whose plan stage takes US more microseconds
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
    g++ -shared -fPIC -O1 -fno-builtin "$(dirname "$0")/slow_stage.cpp" -o "$out/slow_stage.so"
    printf '#!/bin/sh\nLD_PRELOAD=%s exec %s "$@"\n' "$out/slow_stage.so" "$(realpath "$octant")" >"$out/slower"
    chmod +x "$out/slower"
    for us in "${@:4}"; do
      for ((i = 1; i <= $3; ++i)); do SLOW_US=$us compared "$us us" "$out/slower" "$i"; done
    done
    ;;
esac
