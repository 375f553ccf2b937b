#!/bin/bash
# Runs the program $1, made of the source $2, and counts its lines.
set -euo pipefail
"$1"
lines=$(wc -l < "$2")
if (( lines > 40 )); then
  echo "$2 has $lines lines, must have 40 or fewer" >&2
  exit 1
fi
if ldd "$1" | grep -iE 'bullet|LinearMath|mujoco'; then
  echo "$1 is linked with a simulator, must be with none" >&2
  exit 1
fi
