#!/usr/bin/env bash
# Layers of tests beyond ./test.sh, one a name: README.md beside this file.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "error: $*" >&2; exit 2; }
number() { [[ $1 =~ ^[0-9]+$ ]] || fail "expected a number, got $1"; }
jobs=$(nproc)
mkdir -p build

configured() { # preset
  cmake --preset "$1" >"build/$1.log" 2>&1 || { cat "build/$1.log" >&2; fail "configuring failed, see above"; }
}

built() { # preset, targets
  configured "$1"
  cmake --build --preset "$1" -j "$jobs" ${2:+--target "${@:2}"}
}

clang() { built clang; }

asan() {
  built asan
  ctest --preset asan -j "$jobs" --no-tests=error
}

# The modules whose tests the thread sanitizer runs: worker teams, meshing ahead, loading, rendering, links.
threaded_modules=(sim sim/links models/heights models/procedural models/simplify models/measure visuals/draworder
  visuals/separation visuals/ordercache visuals/terrain visuals/groundfile visuals/nature visuals/landscape
  visuals/planning visuals/raster ui/world ui/flight)

tsan() {
  local module programs=() names=()
  for module in "${threaded_modules[@]}"; do
    programs+=("${module//\//_}_unit_tests")
    names+=("^$module:")
  done
  built tsan octant "${programs[@]}"
  export TSAN_OPTIONS="suppressions=$PWD/tests/tsan.supp halt_on_error=1 second_deadlock_stack=1"
  ctest --test-dir build/tsan -j "$jobs" -L unit --no-tests=error --output-on-failure -R "$(IFS='|' && echo "${names[*]}")"
}

fuzz() {
  local seconds=${1:-10} build=$PWD/build/fuzz found=0
  number "$seconds"
  built fuzz
  # As the preset tells the tests.
  export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0 UBSAN_OPTIONS=print_stacktrace=1
  "$build/tests/fuzz/formats/format_replay" --write-corpus "$build/corpus"
  mkdir -p "$build/findings"
  for file in "$build"/corpus/*.dict; do
    local name=${file##*/}
    name=${name%.dict}
    mkdir -p "$build/grown/$name"
    local words=() # of the format; libFuzzer refuses a dictionary without any
    [[ ! -s $build/corpus/$name.dict ]] || words=(-dict="$build/corpus/$name.dict")
    "$build/tests/fuzz/formats/format_fuzzer" --only="$name" -max_total_time="$seconds" -timeout=30 -rss_limit_mb=4096 -max_len=65536 -print_final_stats=1 \
      "${words[@]}" -artifact_prefix="$build/findings/$name-" \
      "$build/grown/$name" "$build/corpus/$name" >"$build/$name.log" 2>&1 || { found=1; tail -n 40 "$build/$name.log"; }
    echo "$name: $(sed -n 's/stat::number_of_executed_units: *//p' "$build/$name.log") executions"
  done
  return "$found"
}

faults() {
  local points=${1:-200}
  number "$points"
  built release octant fault_points
  build/release/tests/faults/fault_points build/release/octant build/release/tests/faults/liboctant_failing_calls.so \
    build/release/faults --points "$points"
}

soak() {
  local minutes=${1:-30} folder=build/soak
  number "$minutes"
  built release octant
  rm -rf "$folder"
  tests/soak.sh build/release/octant "$minutes" "$folder"
}

install() {
  local root=$PWD/build/installed
  built release octant
  rm -rf "$root" && cmake --install build/release --prefix "$root" >build/install.log
  cd "$(mktemp -d)"
  "$root/bin/octant" --help-all >/dev/null
  "$root/bin/octant" fly pop-up --terrain canyon --frames 5 --size 160x120 --record flown --quiet
  "$root/bin/octant" report flown --out page.html --quiet
  [[ -s page.html && -s flown/run.json ]] || { echo "expected page.html and flown/run.json, found: $(ls)"; return 1; }
  echo "runs from $root"
}

long() {
  built release
  ctest --preset evidence -j "$jobs" --no-tests=error
}

case ${1:-} in
  clang | asan | tsan | fuzz | faults | soak | install | long) "$@" ;;
  *) fail "expected clang, asan, tsan, fuzz, faults, soak, install or long, got ${1:-nothing}" ;;
esac
