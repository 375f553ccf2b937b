#!/bin/bash
# Runs the program $1 and checks that its source $2 has at most 40 lines and
# that it is not linked with a simulator.
set -euo pipefail
"$1"
lines=$(wc -l < "$2")
if (( lines > 40 )); then
  echo "$2 has $lines lines, but at most 40 are allowed" >&2
  exit 1
fi
if ldd "$1" | grep -iE 'bullet|LinearMath|mujoco'; then
  echo "$1 is linked with a simulator, but must not be" >&2
  exit 1
fi
