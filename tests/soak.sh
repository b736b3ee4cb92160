#!/usr/bin/env bash
# soak.sh PROGRAM MINUTES FOLDER: a window flies one path over and over; FOLDER/memory.csv holds its memory second by second.
# Exit code 1 when it grew by more than 2 MB after the first minute, or the program ended.
set -euo pipefail
[[ $# -eq 3 ]] || { echo "error: expected PROGRAM MINUTES FOLDER, got $# words" >&2; exit 2; }
program=$1 minutes=$2 folder=$3
mkdir -p "$folder"
xvfb-run -a -s '-screen 0 800x600x24' "$program" view turn --terrain canyon --size 320x240 >"$folder/view.log" 2>&1 &
runner=$!
trap 'kill $viewer 2>/dev/null || true; kill $runner 2>/dev/null || true' EXIT
viewer=
for ((i = 0; i < 60; ++i)); do
  viewer=$(pgrep -n -f "^$program view turn" || true)
  [[ -n $viewer ]] && break
  sleep 1
done
[[ -n $viewer ]] || { echo "error: expected a window, got: $(cat "$folder/view.log")" >&2; exit 2; }
echo "second,resident_kb,threads,files" >"$folder/memory.csv"
for ((second = 0; second <= 60 * minutes; ++second)); do
  [[ -r /proc/$viewer/status ]] || { echo "ended after $second s: $(cat "$folder/view.log")"; exit 1; }
  awk -v s=$second -v files="$(find /proc/$viewer/fd -mindepth 1 2>/dev/null | wc -l)" \
    '/^VmRSS/ {kb=$2} /^Threads/ {threads=$2} END {print s "," kb "," threads "," files}' "/proc/$viewer/status" >>"$folder/memory.csv"
  sleep 1
done
awk -F, 'NR > 1 && $1 <= 60 && $2 > first {first = $2}
  NR > 1 && $1 > 60 && $2 > most {most = $2}
  END {
    printf "%d kB in the first minute, %d kB at most after it: %+d kB\n", first, most, most - first
    exit most == 0 || most - first > 2048
  }' "$folder/memory.csv"
