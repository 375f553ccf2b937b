#!/bin/bash
# Usage: dist_test.sh DIST/sources.sha256
# Fails if a source of the viewer, or a built page, is not the one that the
# check sums were written for, or if a source has none.
set -euo pipefail

sums=$(basename "$1")
cd "$(dirname "$1")/.."
if ! sha256sum --check --strict --quiet "dist/$sums"; then
  echo "tools/viewer/dist is not what the sources build." \
    "Run: npm ci --ignore-scripts && npm run build (in tools/viewer)." >&2
  exit 1
fi
for source in src/*; do
  grep -q "  $source\$" "dist/$sums" || {
    echo "$source is not in dist/$sums: build the pages again." >&2
    exit 1
  }
done
