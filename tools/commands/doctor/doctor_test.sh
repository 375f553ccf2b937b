#!/bin/bash
# Usage: doctor_test.sh DOCTOR URDF
# What scripts rely on: exit codes, one line on stderr, JSON alone on stdout.
set -euo pipefail
doctor=$PWD/$1 urdf=$PWD/$2
cd "$TEST_TMPDIR"

fail() {
  echo "doctor_test.sh: $*" >&2
  exit 1
}

# Usage: expect CODE LINES ARGUMENT...: how it ends, and what stderr has.
expect() {
  local wanted=$1 lines=$2 code=0
  shift 2
  "$doctor" "$@" > out 2> err || code=$?
  [ "$code" = "$wanted" ] || fail "exit code $code for $*, wanted $wanted"
  [ "$(wc -l < err)" = "$lines" ] || fail "stderr of $*: $(cat err)"
}

expect 0 0 "$urdf"
grep -q '^verdict  ok$' out || fail "the table has no verdict: $(cat out)"
expect 0 0 "$urdf" --json
[ "$(head -c 1 out)$(tail -n 1 out)" = "{}" ] || fail "not JSON alone"
grep -q '"verdict": "ok"' out || fail "the JSON has no verdict"

sed 's/<mass value="[^"]*"/<mass value="x"/' "$urdf" > bad.urdf
expect 2 1 bad.urdf
grep -q "^bad.urdf:[0-9]*: link '.*' <mass>: value is 'x', must be a number$" err ||
  fail "the message does not say what is wrong: $(cat err)"
expect 2 1 bad.urdf --json
grep -q '"verdict": "reject"' out || fail "the JSON has no verdict"

expect 2 1 no_such.urdf
expect 2 1 "$urdf" --profile no_such.yaml
printf 'feet:\n  left_foot: 1\n' > bad.yaml
expect 2 1 "$urdf" --profile bad.yaml
grep -q '^bad.yaml:2: ' err || fail "no line of the profile: $(cat err)"
expect 2 1
expect 2 1 "$urdf" --nonsense
expect 0 0 --help

code=0
"$doctor" "$urdf" > /dev/full 2> err || code=$?
[ "$code" = 2 ] || fail "exit code $code where the output is lost, wanted 2"
[ "$(cat err)" = "doctor: the output cannot be written" ] ||
  fail "stderr of lost output: $(cat err)"
