#!/bin/bash
# Usage: sim_to_sim_test.sh SIM_TO_SIM
# Tests that an interrupted table has the rows before the interruption.
set -euo pipefail
sim_to_sim=$1 table=$TEST_TMPDIR/table

fail() {
  echo "sim_to_sim_test.sh: $*" >&2
  exit 1
}

"$sim_to_sim" > "$table" &
child=$!
until [ "$(wc -l < "$table")" -ge 3 ]; do
  kill -0 "$child" 2> /dev/null || fail "all rows come at once, at the end"
  sleep 0.1
done
kill -s KILL "$child"
code=0
wait "$child" 2> /dev/null || code=$?
[ "$code" = 137 ] || fail "all rows come at once, at the end"
# The first scenario of the folder.
grep -q '^| `board` | recovers | recovers |' "$table" || fail "the table is $(cat "$table")"
