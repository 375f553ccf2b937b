#!/bin/bash
# Usage: robustness_test.sh ROBUSTNESS
# Tests which robots of a folder are tried, and that a folder without robots to
# try is an error.
set -euo pipefail
robustness=$1

fail() {
  echo "robustness_test.sh: $*" >&2
  exit 1
}

# Usage: run WANTED_CODE OPTION...: leaves the output in $out and $err.
run() {
  local wanted=$1 code=0
  shift
  "$robustness" "$@" > "$TEST_TMPDIR/out" 2> "$TEST_TMPDIR/err" || code=$?
  out=$(cat "$TEST_TMPDIR/out") err=$(cat "$TEST_TMPDIR/err")
  [ "$code" = "$wanted" ] ||
    fail "$*: exit code is $code, must be $wanted: $out $err"
}

# Usage: refuse MESSAGE OPTION...: the options must be rejected with MESSAGE.
refuse() {
  local message=$1
  shift
  run 2 "$@"
  [ "$err" = "robustness: $message" ] || fail "$* prints: $err"
  [ -z "$out" ] || fail "$* is rejected, but prints on stdout: $out"
}

refuse "/nonexistent: must be a folder of URDF files" --robots /nonexistent
refuse "--only is 'nosuch', must be part of the name of a row" --only nosuch

robots=$TEST_TMPDIR/robots
mkdir "$robots"
refuse "$robots: must be a folder of URDF files" --robots "$robots"

# An unknown robot with a profile next to its URDF, and a robot without feet.
cp robot/models/humanoid.urdf "$robots/mine.urdf"
cp robot/profiles/humanoid.yaml "$robots/mine.yaml"
echo '<robot name="box"><link name="b"/></robot>' > "$robots/box.urdf"
refuse "--only is 'nosuch', must be part of the name of a row" \
  --robots "$robots" --only nosuch
run 0 --robots "$robots"
grep -q '^| mine stands |.* --profile mine.yaml` | recovers |.*| yes |$' \
  <<< "$out" || fail "mine does not stand: $out"
grep -q '^| mine, pushed |.*| recovers |.*| yes |$' <<< "$out" ||
  fail "mine is not pushed: $out"
[ "$(wc -l <<< "$out")" = 6 ] || fail "the table must have two rows: $out"
grep -q "^2 of 2 rows as they must be$" <<< "$out" || fail "no count: $out"
grep -q '^robustness: box.urdf is skipped: ' <<< "$err" ||
  fail "no message says that box.urdf is skipped: $err"
[ "$(wc -l <<< "$err")" = 1 ] || fail "stderr must have one line: $err"

# Without a profile the feet and the posture are found, as by push. Knees this
# weak cannot hold the robot.
rm "$robots/mine.urdf" "$robots/mine.yaml"
sed -e '/<joint name="._knee"/,/<\/joint>/s/effort="[^"]*"/effort="2.5"/' \
  -e 's/<robot name="humanoid"/<robot name="weak"/' \
  robot/models/humanoid.urdf > "$robots/weak.urdf"
run 1 --robots "$robots" --only 'weak stands'
grep -q '^| weak stands |.* weak.urdf` | falls at .*| \*\*no\*\* |$' <<< "$out" ||
  fail "the robot with weak knees stands: $out"

# A robot that cannot be simulated is not tried: this folder has nothing to try.
rm "$robots/weak.urdf"
run 2 --robots "$robots"
[ "$(tail -n 1 <<< "$err")" = "robustness: $robots: has no robot with feet" ] ||
  fail "a folder without robots prints: $err"
