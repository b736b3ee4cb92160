#!/usr/bin/env bash
# Installs what is needed, builds with warnings as errors and asserts on, and runs every test.
set -euo pipefail
cd "$(dirname "$0")"
fail() { echo "error: $*" >&2; exit 2; }
[[ $# -eq 0 ]] || fail "expected no arguments, got: $*"

.ci/install-packages
free_mb=$(df -Pm . | awk 'NR==2 {print $4}')
[[ $free_mb -ge 1500 ]] || fail "expected 1500 MB free in $PWD, got $free_mb MB"
echo "== configuring (build/ci)"
mkdir -p build
cmake --preset ci >build/configure.log 2>&1 || { cat build/configure.log >&2; fail "configuring failed, see above"; }
echo "== building, every header by itself too"
cmake --build --preset ci --parallel "$(nproc)"
echo "== testing"
ctest --preset ci -j $(($(nproc) + 1)) || fail "a test failed; its output is above, all of it in build/ci/Testing/Temporary/LastTest.log"
echo "All tests passed. Next: ./demo.sh flies eight flights and writes a report."
