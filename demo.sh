#!/usr/bin/env bash
# Installs what is needed, builds, flies the four paths with both aircraft and writes a report.
# A second run skips the flights that are done.
set -euo pipefail
cd "$(dirname "$0")"
fail() { echo "error: $*" >&2; exit 2; }
[[ $# -eq 0 ]] || fail "expected no arguments, got: $*"

.ci/install-packages
free_mb=$(df -Pm . | awk 'NR==2 {print $4}')
[[ $free_mb -ge 1500 ]] || fail "expected 1500 MB free in $PWD, got $free_mb MB"
echo "== configuring (build/release)"
mkdir -p build
cmake --preset release >build/configure.log 2>&1 || { cat build/configure.log >&2; fail "configuring failed, see above"; }
echo "== building"
cmake --build --preset release --parallel "$(nproc)" --target octant

octant=build/release/octant
out=build/flights
mkdir -p "$out"
flight=0
fly() { # aircraft path terrain view
  flight=$((flight + 1))
  echo "== flight $flight of 8: $1 $2 over $3, $4 view"
  "$octant" fly "$2" --aircraft "$1" --terrain "$3" --view "$4" --size 640x360 --frame-per-sample \
    --pictures 20 --record "$out/$1-$2" --if-new
}
fly f15 straight hills chase
fly f15 jinking canyon chase
fly f15 pop-up hills tower
fly f15 turn canyon orbit
fly 500md straight canyon chase
fly 500md jinking hills chase
fly 500md pop-up canyon tower
fly 500md turn hills orbit
echo "== report"
"$octant" report "$out"/f15-* "$out"/500md-* --out "$out/report.html"
echo "Done. Open $PWD/$out/report.html in a browser."
echo "Next: $octant view   (a window: fly along or by hand)
      $octant fly pop-up --aircraft f15 --terrain canyon --record my-flight   ($octant --help for all)"
