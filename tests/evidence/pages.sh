#!/usr/bin/env bash
# Makes the pages that recompute_pages.py recomputes (pages.md), a folder each, in a new folder. Takes three minutes.
#   pages.sh OCTANT FOLDER && recompute_pages.py FOLDER
set -euo pipefail
octant=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
mkdir "$2" && cd "$2"

fly() { "$octant" fly turn --terrain hills --size 320x240 --quiet "$@" >/dev/null; }
report() { "$octant" report --quiet "$@" || true; } # exit code 1: rows are not those of the summary, as the page says
compare() { "$octant" compare --quiet "$@" >/dev/null || true; } # exit code 1 or 3: an answer

# One flight, repeats of it, two settings in the order of time, and alternating.
fly --frames 150 --record one/flight --adapt terrain
for i in 1 2 3 4; do fly --frames 100 --record "repeats/r$i"; done
report repeats/r* --out repeats/report.html
for i in 1 2 3; do fly --frames 100 --record "settings/exact-$i"; done
for i in 1 2 3; do fly --frames 100 --hidden-surface depth-buffer --record "settings/depth-$i"; done
report settings/exact-* settings/depth-* --out settings/report.html
# Two settings files, and a program that waits for 2 ms in the plan stage of frames 40 to 70.
mkdir files delayed
printf '{"path": "turn", "frames": 150, "size": "320x240", "triangles": 4000}\n' >files/few.json
printf '{"path": "turn", "frames": 150, "size": "320x240", "triangles": 16000}\n' >files/many.json
compare files/few.json files/many.json --rounds 6 --out files/result
g++ -shared -fPIC -O1 -fno-builtin "$here/slow_stage.cpp" -o delayed/slow_stage.so
printf '#!/bin/sh\nLD_PRELOAD=%s SLOW_US=2000 SLOW_FIRST=40 SLOW_LAST=70 exec %s "$@"\n' "$PWD/delayed/slow_stage.so" \
  "$octant" >delayed/slower
chmod +x delayed/slower
compare "$octant" delayed/slower --settings files/few.json --rounds 8 --out delayed/result
# A sweep with variants and flights, one with --paper, and its recordings with a baseline.
cat >matrix.toml <<'END'
name = "matrix"
repeats = 6
[settings]
size = "320x240"
frames = 60
[vary]
path = ["turn", "jinking", "pop-up"]
[vary.ground.coarse]
triangles = 2000
[vary.ground.usual]
triangles = 8000
[vary.ground.as-printed]
triangles = 8000
terrain-lod = "paper"
END
"$octant" sweep matrix.toml --out matrix --quiet >/dev/null || true
cat >paper.toml <<'END'
name = "paper"
repeats = 4
[settings]
size = "320x240"
frames = 130
[vary]
aircraft = ["f15", "500md"]
order-method = ["exact", "paper"]
END
"$octant" sweep paper.toml --out paper --paper --quiet >/dev/null || true
mkdir baseline
report matrix/runs/*turn* --baseline "$(cd matrix/runs && printf '%s\n' *turn* | tail -n 1)" --out baseline/report.html
# A stopped sweep, and flights too short for percentiles.
sed -e '1s/matrix/stopped/' -e 's/frames = 60/frames = 200/' matrix.toml >stopped.toml
timeout --signal INT 20 "$octant" sweep stopped.toml --out stopped --quiet >/dev/null || true
sed -e '1s/paper/short/' -e 's/frames = 130/frames = 28/' paper.toml >short.toml
"$octant" sweep short.toml --out short --paper --quiet >/dev/null || true
# Frame times that other programs recorded.
/usr/bin/python3 "$here/recompute_pages.py" --captures captures
report captures/presentmon-1.csv --out captures/one.html
report captures/presentmon-*.csv captures/capframex-*.csv captures/capframex-*.json captures/mangohud-*.csv \
  --out captures/report.html
mkdir captures/old captures/new
mv captures/old-*.csv captures/old && mv captures/new-*.csv captures/new
compare captures/old captures/new --out captures/result
# Existing recordings, of more flights than a table shows at once.
mkdir many
for i in $(seq 1 110); do
  cp -r "repeats/r$((i % 4 + 1))" "many/r$i" && rm -f "many/r$i"/*.png
done
report many/r* --out many/report.html
