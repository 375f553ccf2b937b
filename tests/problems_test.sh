#!/bin/bash
# Usage: problems_test.sh PROGRAM...
# Tests that the programs that draw random hierarchies reject a number of hierarchies
# below 1. As an unsigned number, -1 would be 18446744073709551615.
set -euo pipefail

for program; do
  for problems in -1 0 1e3; do
    code=0
    err=$(timeout 20 "$program" "--problems=$problems" --out "$TEST_TMPDIR" 2>&1) || code=$?
    wanted="--problems is '$problems', must be a whole number from 1 to 1000000000"
    if [ "$code" != 2 ] || [ "$err" != "$(basename "$program"): $wanted" ]; then
      echo "problems_test.sh: $program exits with $code and prints: $err" >&2
      exit 1
    fi
  done
  "$program" --problems 2 --out "$TEST_TMPDIR"
done
