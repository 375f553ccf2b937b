#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Runs the quadruped $1, and compares its numbers with closed forms. The source
# $2 must have at most 40 lines and include only public headers of Poise.
set -euo pipefail
"$1" | tee output
lines=$(wc -l < "$2")
if (( lines > 40 )); then
  echo "$2 has $lines lines, but at most 40 are allowed" >&2
  exit 1
fi
if grep '#include "' "$2" | grep -vE '"poise/(math|dynamics)/[a-z_]+\.h"'; then
  echo "$2 includes a header that is not public" >&2
  exit 1
fi

# A quarter of the weight acts on a foot straight below its hip. The knee is
# 0.2 m sin(0.7) behind that line, and half a shank's weight acts against it.
# The trunk turns about the vertical with 1 rad/s, so that the left front foot at
# (0.2, 0.1) m moves with 0.5 m/s - 0.1 m/s forward and 0.2 m/s to the left.
awk -v g=9.81 -v mass=15 '
function check(what, value, wanted) {
  if (value - wanted > 1e-3 || wanted - value > 1e-3) {
    print what " is " value ", must be " wanted; bad = 1
  }
}
{
  gsub(",", "")
  check("weight", $2, mass * g)
  check("force on the base", $5, 0)
  lever = 0.2 * sin(0.7)
  check("torque of the knee", $8, (mass * g / 4 - 0.5 * g / 2) * lever)
  check("foot forward", $12, 0.4)
  check("foot left", $13, 0.2)
  check("angular momentum", $16, $19)
  check("linear momentum", $17, mass * 0.5)
}
END { exit bad || NR != 1 }' output
