#!/bin/bash
# Usage: dist_test.sh DIST/sources.sha256
# Fails if a source of the viewer or a built page does not have its check sum, or
# if a source has no check sum.
set -euo pipefail

sums=$(basename "$1")
cd "$(dirname "$1")/.."
if ! sha256sum --check --strict --quiet "dist/$sums"; then
  echo "tools/viewer/dist was not built from these sources." \
    "Run in tools/viewer: npm ci --ignore-scripts && npm run build" >&2
  exit 1
fi
for source in src/*; do
  grep -q "  $source\$" "dist/$sums" || {
    echo "$source is not in dist/$sums: run npm run build in tools/viewer" >&2
    exit 1
  }
done
