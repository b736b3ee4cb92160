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

wait_for_done() { # FOLDER COUNT
  local tenth
  for tenth in {1..1200}; do
    [[ $(done_in "$1") -ge $2 ]] && return 0
    sleep 0.1
  done
  fail "expected $2 flights done in $1, got $(done_in "$1")"
}

fly_locally() {
  "$octant" sweep "$scratch/many.toml" --out "$scratch/local" --share-cores --quiet ||
    fail "the local sweep failed"
  [[ $(hashes "$scratch/local" | sort -u | wc -l) -eq 48 ]] || fail "expected 48 flights done locally"
}

compare_with_local() {
  diff <(hashes "$scratch/local") <(hashes "$1") >&2 || fail "flights differ from those flown locally"
}
