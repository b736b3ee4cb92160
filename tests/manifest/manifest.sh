#!/usr/bin/env bash
# Lists what must not change while code is moved and renamed: one line "name values" of hashes for each flight (states
# and pictures), painting order, certificate, simplified or refined mesh, made ground and study. No line depends on
# time or threads. Real maps and meshes are those of ../shared/data beside the checkout; without them
# their lines are left out.
#   manifest.sh OCTANT          prints the manifest
#   manifest.sh OCTANT check    compares it with manifest.txt; exit code 1 and the lines that differ
#   manifest.sh OCTANT whole    prints the eight whole flights and the longer studies (minutes), which the other modes leave out
set -euo pipefail
# The C library's sin, exp and pow round the last bit differently with fused multiply-add; without it on every processor.
export GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX512F,-AVX2,-FMA,-FMA4
octant=$(realpath "$1")
self=$(realpath "$0")
mode=${2:-print}
expected=$(realpath "$(dirname "$0")/manifest.txt")
data=$(realpath -m "$(dirname "$0")/../../../shared/data")
source_models=$(realpath "$(dirname "$0")/../../models")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# flight NAME OPTION...: state and picture hash of `octant fly`.
flight() {
  local name=$1
  shift
  "$octant" fly "$@" --quiet --json --order-cache orders | awk -v name="flight/$name" -F'"' '
    /"state_hash"/ { state = $4 } /"picture_hash"/ { picture = $4 }
    END { print name, (state != "" && picture != "") ? state " " picture : "FAILED" }'
}
# files NAME COMMAND...: exit code of the command, and SHA-256 of what it leaves in the folder out/ (names and bytes).
files() {
  local name=$1 code=0
  shift
  rm -rf out
  mkdir out
  "$octant" "$@" --quiet >text 2>notes || code=$?
  (cd out && find . -type f | LC_ALL=C sort | xargs sha256sum) | sha256sum | awk -v name="$name" -v code=$code '{ print name, code, substr($1, 1, 16) }'
}
# study NAME FILE...: SHA-256 of those files of the study's that hold no times.
study() {
  local name=$1
  shift
  [ -d "study-$name" ] || "$octant" study "$name" --out "study-$name" --quiet >text 2>notes || true
  (cd "study-$name" && cat "$@") | sha256sum | awk -v name="study/$name" '{ print name, substr($1, 1, 16) }'
}
if [ "$mode" = check ]; then
  "$self" "$octant" >now
  if grep -Fxvf "$expected" now; then
    echo "These lines differ from $expected." >&2
    exit 1
  fi
  exit 0
fi

frames=40
[ "$mode" != whole ] || frames=100000
small="--size 320x180"
for path in straight jinking pop-up turn; do
  flight "f15-$path" $path --aircraft f15 --terrain hills $small --frames $frames
  flight "500md-$path" $path --aircraft 500md --terrain canyon $small --frames $frames --view cockpit
done
if [ "$mode" = whole ]; then
  study flicker damping.csv fixed-gentle.csv fixed-rugged.csv path-gentle.csv path-rugged.csv path.csv relief.csv stability.csv
  study refinement forced-splits.csv
  study shading control.csv gain.csv operations.csv quality-500md.csv quality-f15.csv
  "$octant" study simplification --paper-only --out study-simplification --quiet >text 2>notes
  sed -i 's/,[^,]*$//' study-simplification/table-2.csv # its last column holds times
  study simplification table-1.csv table-2.csv
  exit 0
fi
flight f15-detailed-tower pop-up --aircraft f15-detailed --terrain canyon --view tower $small --frames 20
flight everything turn --aircraft f15 --aircraft 500md=straight --effects --clouds 0.4 --show airfield,path-ribbon --inset cockpit $small --frames 20
flight paper-terrain jinking --terrain-lod paper --triangles 4000 $small --frames 20
flight paper-order straight --order-method paper --shading-rule paper --smooth-share 0.5 $small --frames 20
flight divided straight --order-seconds 0.001 $small --frames 20
flight depth-buffer straight --hidden-surface depth-buffer --samples 4 $small --frames 20
for map in gcanyon_1025 pugetsound_1025 vancouver_2049 srtm3_N49W123 gcanyon_1025_smooth; do
  [ ! -e "$data/terrain/$map.tif" ] || flight "map-$map" pop-up --terrain "$data/terrain/$map.tif" $small --frames 20
done
for track in f15_jink md500_popup; do
  [ ! -e "$data/paths/$track.csv" ] || flight "track-$track" "$data/paths/$track.csv" $small --frames 20
done

for model in f15 500md f15-detailed concave; do
  files "order/$model" draw-order $model --export out/orders.txt --rays 0
done
for model in f15 500md concave; do
  files "certificate/$model" draw-order $model --certificate out/proof.txt --rays 0
done
files order/f15-paper draw-order f15 --method paper --export out/orders.txt --rays 0
files order/f15-divided draw-order f15 --method bsp --export out/orders.txt --export-model out/model.obj --rays 0

for mesh in f15-detailed 500md-detailed f15-cockpit; do
  files "simplify/$mesh" simplify "$source_models/$mesh.obj" out/mesh.obj --faces 200
done
for mesh in globe torus machined-part; do
  files "simplify/$mesh" simplify $mesh out/mesh.ply --faces 300
  files "refine/$mesh" refine $mesh --base 60 --save out/mesh.pm
done
files simplify/fast simplify torus out/mesh.obj --faces 300 --method fast
files simplify/paper simplify globe out/mesh.obj --faces 200 --method triangle
files simplify/error simplify torus out/mesh.glb --error 0.01
for mesh in cow.obj spot.obj; do
  [ ! -e "$data/meshes/$mesh" ] || files "simplify/$mesh" simplify "$data/meshes/$mesh" out/mesh.obj --faces 500
done
for mesh in pinholes studs t-cap tile-west; do
  [ ! -e "$data/found/meshes/$mesh.obj.gz" ] || gunzip -c "$data/found/meshes/$mesh.obj.gz" >$mesh.obj
  [ ! -e "$data/found/meshes/$mesh.obj" ] || cp "$data/found/meshes/$mesh.obj" .
  [ ! -e $mesh.obj ] || files "simplify/$mesh" simplify $mesh.obj out/mesh.obj --faces 500
done

files terrain/hills terrain make --kind hills --size 257 --seed 7 --out out/made.tif
files terrain/canyon terrain make --kind canyon --size 257 --seed 7 --out out/made.tif
mv out/made.tif made.tif
files terrain/ground terrain import made.tif --out out/made.ground
files terrain/mesh terrain mesh made.tif --eye 0,0,900 --look 500,500,0 --triangles 5000 --out out/mesh.ply
files terrain/mesh-paper terrain mesh made.tif --eye 0,0,900 --look 500,500,0 --terrain-lod paper --triangles 5000 --out out/mesh.ply

study draw-order table-4.csv wrong-pixels.csv
