#!/bin/bash
# Reports of 1, 2, 8, 200 and 10,000 runs in a browser, 390, 1400 and 1920 px wide, and as a printer
# lays them out: nothing cut, nothing overlapping, no text below 11 px. Screenshots are left in the
# folder that is named.
#   reports_in_browser.sh OCTANT FOLDER
set -u
here=$(cd "$(dirname "$0")" && pwd)
octant=$1
folder=$2
browser=$(command -v chromium || command -v google-chrome || true)
[[ -n $browser ]] || { echo "SKIPPED: chromium is not installed"; exit 0; }
fail() { echo "FAILED: $*" >&2; exit 1; }
study=a-study-with-a-name-as-long-as-people-give # whole paths stand in the page of 200
rm -rf "$folder"
mkdir -p "$folder/profile"
cat >"$folder/eight.toml" <<'EOF'
name = "eight"
repeats = 2
[settings]
size = "320x180"
seconds = 5
rate = 20
triangles = 3000
terrain = "background60"
[vary]
path = ["straight", "turn"]
order-method = ["exact", "cells"]
EOF
"$octant" sweep "$folder/eight.toml" --out "$folder/$study" --batch share-cores --quiet || fail "the sweep failed"
runs=("$folder/$study"/runs/*)
"$octant" report "${runs[0]}" --out "$folder/report-1.html" --quiet || fail "report of one"
"$octant" report "${runs[0]}" "${runs[2]}" --out "$folder/report-2.html" --quiet || fail "report of two"
"$octant" report "${runs[@]}" --out "$folder/report-8.html" --quiet || fail "report of eight"
many=()
for i in {1..25}; do many+=("${runs[@]}"); done
"$octant" report "${many[@]}" --out "$folder/report-200.html" --quiet || fail "report of two hundred"
for i in {1..49}; do many+=("${many[@]:0:200}"); done
"$octant" report "${many[@]}" --out "$folder/report-10000.html" --quiet || fail "report of ten thousand"
[[ $(stat -c %s "$folder/report-8.html") -lt 3000000 ]] || fail "the report of eight takes 3 MB or more"

bad=0
for page in 1 2 8 200 10000; do
  { cat "$folder/report-$page.html"; echo "<script>"; cat "$here/check_page.js"; echo "</script>"; } >"$folder/checked-$page.html"
  for width in 390 1400 1920; do
    options=(--headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$folder/profile"
      --window-size="$width,2400" --virtual-time-budget=4000)
    "$browser" "${options[@]}" --screenshot="$folder/report-$page-$width.png" "file://$folder/report-$page.html" >/dev/null 2>&1
    verdict=$("$browser" "${options[@]}" --dump-dom "file://$folder/checked-$page.html" 2>/dev/null |
      sed -n '/<pre id="verdict">/,/END/p')
    echo "$page runs, $width px: $(head -n 1 <<<"$verdict")"
    grep -q "FAULTS 0" <<<"$verdict" || { echo "$verdict" >&2; bad=1; }
    [[ -s $folder/report-$page-$width.png ]] || { echo "no screenshot" >&2; bad=1; }
  done
done
exit $bad
