#!/bin/bash
# Runs the program $1, made of the source $2, and counts its lines.
set -euo pipefail
"$1"
lines=$(sed -n '/^int main/,$p' "$2" | wc -l)
if (( lines > 40 )); then
  echo "main() of $2 has $lines lines, must be 40 or fewer" >&2
  exit 1
fi
