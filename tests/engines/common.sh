# Sourced: what both tests of engines share. Prints "SKIPPED: why" where something is missing.
set -u
octant=$1
scratch=$(mktemp -d "${TMPDIR:-/tmp}/octant-engines-XXXXXX")

fail() { echo "FAILED: $*" >&2; exit 1; }

write_sweep() { # 48 flights, two frames each
  cat >"$scratch/many.toml" <<'EOF'
name = "many"
[settings]
size = "48x32"
frames = 2
warm-up = 0
pictures = 0
[vary]
path = ["straight", "jinking", "pop-up", "turn"]
aircraft = ["f15", "500md"]
terrain = ["none", "background60"]
fov = { from = 40, to = 60, step = 10 }
EOF
}

hashes() { # of a sweep's runs: name, states, pictures
  python3 - "$1/sweep.csv" <<'EOF'
import csv, sys
for row in csv.DictReader(open(sys.argv[1])):
    print(row["run"], row["state_hash"], row["picture_hash"])
EOF
}

done_in() { grep -l '"summary"' "$1"/runs/*/run.json 2>/dev/null | wc -l; }

wait_for_done() { # FOLDER COUNT PROCESS: until so many flights are done, while the sweep's process lives
  while [[ $(done_in "$1") -lt $2 ]]; do
    kill -0 "$3" 2>/dev/null || fail "expected $2 flights done in $1, got $(done_in "$1") when the sweep ended"
    sleep 0.1
  done
}

fly_locally() {
  "$octant" sweep "$scratch/many.toml" --out "$scratch/local" --batch share-cores --quiet ||
    fail "the local sweep failed"
  [[ $(hashes "$scratch/local" | sort -u | wc -l) -eq 48 ]] || fail "expected 48 flights done locally"
}

# A sweep of flights that take a minute each is ended by a signal: no more flights begin, those that
# fly end, and the sweep ends as the signal has it. FOLDER OPTIONS...
end_by_signal() {
  local folder=$1 tenth code sweep
  shift
  cat >"$scratch/long.toml" <<'EOT'
name = "long"
[settings]
path = "straight"
terrain = "none"
size = "48x32"
realtime = true
seconds = 60
[vary]
fov = { from = 40, to = 60, step = 2 }
EOT
  "$octant" sweep "$scratch/long.toml" --out "$folder" "$@" --quiet &
  sweep=$!
  for tenth in {1..600}; do
    [[ $(cat "$folder"/runs/*/frames.csv 2>/dev/null | wc -l) -gt 20 ]] && break
    sleep 0.1
  done
  kill -TERM "$sweep"
  wait "$sweep"
  code=$?
  [[ $code -eq 143 ]] || fail "a sweep that SIGTERM ended has exit code $code"
  for tenth in {1..1200}; do
    pgrep -f "fly --settings jobs/.*--record runs/" >/dev/null || break
    sleep 0.1
  done
  for process in $(pgrep -f "fly --settings jobs/.*--record runs/"); do
    [[ $(readlink "/proc/$process/cwd") != "$folder" ]] || fail "a flight goes on after the sweep has ended"
  done
  [[ $(ls "$folder/runs" | wc -l) -lt 11 ]] || fail "flights began after the signal"
}

compare_with_local() {
  diff <(hashes "$scratch/local") <(hashes "$1") >&2 || fail "flights differ from those flown locally"
}
