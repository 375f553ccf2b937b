#!/bin/bash
# Usage: robustness_test.sh ROBUSTNESS
# Which robots of a folder are tried, and that nothing to try is no success.
set -euo pipefail
robustness=$1

fail() {
  echo "robustness_test.sh: $*" >&2
  exit 1
}

# Usage: run WANTED_CODE OPTION...: what it says is in $out and $err.
run() {
  local wanted=$1 code=0
  shift
  "$robustness" "$@" > "$TEST_TMPDIR/out" 2> "$TEST_TMPDIR/err" || code=$?
  out=$(cat "$TEST_TMPDIR/out") err=$(cat "$TEST_TMPDIR/err")
  [ "$code" = "$wanted" ] ||
    fail "exit code $code for $*, wanted $wanted: $out $err"
}

# Usage: refuse MESSAGE OPTION...
refuse() {
  local message=$1
  shift
  run 2 "$@"
  [ "$err" = "robustness: $message" ] || fail "$* says: $err"
  [ -z "$out" ] || fail "$* is refused, and prints all the same"
}

refuse "/nonexistent: must be a folder of URDF files" --robots /nonexistent
refuse "--only is 'nosuch', must be part of the name of a row" --only nosuch

robots=$TEST_TMPDIR/robots
mkdir "$robots"
refuse "$robots: must be a folder of URDF files" --robots "$robots"

# A robot that nobody knows here, with a profile beside it; one that has no feet.
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
[ "$(wc -l <<< "$out")" = 4 ] || fail "not two rows: $out"
grep -q '^robustness: box.urdf is skipped: ' <<< "$err" ||
  fail "box.urdf is skipped without a word: $err"
[ "$(wc -l <<< "$err")" = 1 ] || fail "says more than a line: $err"

# Without a profile it is found, as by push; knees so weak do not hold it.
rm "$robots/mine.urdf" "$robots/mine.yaml"
sed -e '/<joint name="._knee"/,/<\/joint>/s/effort="[^"]*"/effort="2.5"/' \
  -e 's/<robot name="humanoid"/<robot name="weak"/' \
  robot/models/humanoid.urdf > "$robots/weak.urdf"
run 1 --robots "$robots" --only 'weak stands'
grep -q '^| weak stands |.* weak.urdf` | falls at .*| \*\*no\*\* |$' <<< "$out" ||
  fail "weak knees stand: $out"

# One that no simulator takes is nothing to try either.
rm "$robots/weak.urdf"
run 2 --robots "$robots"
[ "$(tail -n 1 <<< "$err")" = "robustness: $robots: has no robot with feet" ] ||
  fail "a folder without robots says: $err"
