#!/bin/bash
# Usage: doctor_test.sh DOCTOR URDF
# Checks what scripts rely on: exit codes, one line on stderr, only JSON on stdout.
set -euo pipefail
doctor=$PWD/$1 urdf=$PWD/$2
cd "$TEST_TMPDIR"

fail() {
  echo "doctor_test.sh: $*" >&2
  exit 1
}

# Usage: expect CODE LINES ARGUMENT...: doctor must exit with CODE and print LINES
# lines on stderr.
expect() {
  local wanted=$1 lines=$2 code=0
  shift 2
  "$doctor" "$@" > out 2> err || code=$?
  [ "$code" = "$wanted" ] || fail "$*: exit code is $code, must be $wanted"
  [ "$(wc -l < err)" = "$lines" ] || fail "$*: stderr must have $lines lines: $(cat err)"
}

expect 0 0 "$urdf"
grep -q '^verdict  ok$' out || fail "the table has no verdict: $(cat out)"
expect 0 0 "$urdf" --json
[ "$(head -c 1 out)$(tail -n 1 out)" = "{}" ] || fail "stdout has more than one JSON document: $(cat out)"
grep -q '"verdict": "ok"' out || fail "the JSON has no verdict"

sed 's/<mass value="[^"]*"/<mass value="x"/' "$urdf" > bad.urdf
expect 2 1 bad.urdf
grep -q "^doctor: bad.urdf:[0-9]*: link '.*' <mass>: value is 'x', must be a number$" err ||
  fail "the message does not name the mass and its value: $(cat err)"
expect 2 1 bad.urdf --json
grep -q '"verdict": "reject"' out || fail "the JSON has no verdict"

expect 2 1 no_such.urdf
[ "$(cat err)" = "doctor: no_such.urdf: cannot be read: No such file or directory" ] ||
  fail "a missing file: stderr is $(cat err)"
grep -q '^next  *bazel run //tools:doctor -- ROBOT.urdf  # with a URDF file that can be read$' out ||
  fail "the advice about a missing file is: $(cat out)"
expect 2 1 "$urdf" --profile no_such.yaml
printf 'feet:\n  left_foot: 1\n' > bad.yaml
expect 2 1 "$urdf" --profile bad.yaml
grep -q '^doctor: bad.yaml:2: ' err || fail "the message has no line number of the profile: $(cat err)"

# The saved profile must not replace an input, nor what a link points to.
cp "$urdf" mine.urdf
ln -s mine.urdf link.yaml
for name in mine.urdf ./mine.urdf link.yaml; do
  expect 2 1 mine.urdf --save-profile "$name"
  [ "$(cat err)" = "doctor: $name: is the robot's file and would be replaced, choose another name" ] ||
    fail "--save-profile $name: stderr is $(cat err)"
  cmp "$urdf" mine.urdf || fail "--save-profile $name replaces the robot's file"
done
expect 0 0 mine.urdf --save-profile new.yaml
expect 2 1 mine.urdf --profile new.yaml --save-profile new.yaml

expect 2 1
expect 2 1 "$urdf" --nonsense
expect 0 0 --help

code=0
"$doctor" "$urdf" > /dev/full 2> err || code=$?
[ "$code" = 2 ] || fail "output to a full device: exit code is $code, must be 2"
[ "$(cat err)" = "doctor: the output cannot be written" ] ||
  fail "output to a full device: stderr is $(cat err)"
