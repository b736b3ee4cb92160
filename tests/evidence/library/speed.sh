#!/usr/bin/env bash
# Speed of liboctant (../library.md): speed.sh BUILD [BULLET3]. BUILD: a release build with octant; BULLET3: an unpacked source tree of bullet3
# (examples/TinyRenderer, examples/OpenGLWindow/ShapeData.h, examples/CommonInterfaces, examples/Utils, src/LinearMath, src/Bullet3Common).
# PICTURES: how many are drawn in a row for the memory (100,000).
set -euo pipefail
build=$(realpath "$1") bullet=${2:+$(realpath "$2")}
root=$(realpath "$(dirname "$0")/../../..")
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
flags=(-std=c++20 -O3 -march=native -DNDEBUG -I "$root" -I "$root/ui/library" -I "$root/sim/base")
objects=()
if [[ -n $bullet ]]; then
  tiny=(-I "$bullet/examples/TinyRenderer" -isystem "$bullet/examples" -isystem "$bullet/src")
  for name in examples/TinyRenderer/{TinyRenderer,model,our_gl,tgaimage,geometry} examples/Utils/b3ResourcePath \
    src/LinearMath/btAlignedAllocator src/Bullet3Common/{b3AlignedAllocator,b3Logging}; do
    g++ -O3 -march=native -DNDEBUG -w "${tiny[@]}" -c "$bullet/$name.cpp" -o "$out/$(basename "$name").o"
    objects+=("$out/$(basename "$name").o")
  done
  g++ -std=c++17 -O3 -march=native -DNDEBUG -I "$root" "${tiny[@]}" -c "$(dirname "$0")/tiny_picture.cpp" -o "$out/tiny_picture.o"
  objects+=("$out/tiny_picture.o")
  flags+=(-DTINY_RENDERER)
fi
g++ "${flags[@]}" "$(dirname "$0")/speed.cpp" "$root/tests/ui/library/rays/ray_scene.cpp" "${objects[@]}" -o "$out/speed" \
  -L "$build" -loctant -lembree3 -Wl,-rpath,"$build"
for what in compare scale "memory ${PICTURES:-100000}"; do "$out/speed" $what; done
for _ in 1 2 3 4 5; do "$out/speed" first; done
# The program's two renderers, one flight: CPU time a frame from the difference of a long and a short run.
for renderer in raster "gl --context osmesa --samples 1"; do
  cpu() {
    local TIMEFORMAT="%U %S"
    { time "$build/octant" fly turn --aircraft f15-detailed --terrain hills --triangles 3000 --size 128x128 --rate 100 --frames "$1" \
      --raster-threads 1 --renderer $renderer --quiet >/dev/null 2>&1; } 2>&1 | awk '{print $1 + $2}'
  }
  cpu 100 >/dev/null
  short=$(cpu 100) long=$(cpu 1100)
  echo "octant fly --renderer $renderer, 128 x 128: $(awk "BEGIN {printf \"%.0f\", 1000 / ($long - $short)}") frames a CPU second"
done
