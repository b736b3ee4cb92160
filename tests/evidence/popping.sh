#!/bin/bash
# popping.sh OCTANT MAP...: the largest jump of a vertex along the four paths over each map, at 20000 and 40000 triangles (popping.md).
set -euo pipefail
octant=$1
shift
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
for map in "$@"; do
  for triangles in 20000 40000; do
    "$octant" study popping --terrain "$map" --triangles $triangles --out "$out" --quiet |
      grep -F '| screen-error, geomorphs |' | sed "s#^#| $(basename "$map") | $triangles #"
  done
done
