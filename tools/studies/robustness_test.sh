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
# Without EXPECTED.json, a robot that is refused is no fault.
cp robot/models/humanoid.urdf "$robots/mine.urdf"
cp robot/profiles/humanoid.yaml "$robots/mine.yaml"
echo '<robot name="box"><link name="b"/></robot>' > "$robots/box.urdf"
refuse "--only is 'nosuch', must be part of the name of a robot" \
  --robots "$robots" --only nosuch
run 0 --robots "$robots" --only box
grep -q '^| box | | refused: box.urdf:1: .* | yes |$' <<< "$out" || fail "box is not refused: $out"
grep -q "^1 of 1 robots as expected$" <<< "$out" || fail "no count: $out"
[ -z "$err" ] || fail "there is a warning: $err"

# EXPECTED.json says what a robot must do. To try a robot that stands is slow, so the
# page and the document are of one run.
cat > "$robots/EXPECTED.json" << 'END'
{"mine": {"stands": true, "left_foot_link": "r_foot", "forward": "-x"},
 "box": {"stands": true}}
END
run 1 --robots "$robots" --json --out "$TEST_TMPDIR/page"
page=$TEST_TMPDIR/page/robots.md
row='^| !\[mine\](figures/robots/mine.png) | mine | profile '
row+='| [0-9]* mm, 6 of 6 seeds | [0-9]* mm, [0-9]* mm, [0-9]* mm, [0-9]* mm '
row+='| [0-9]* mm | \*\*no\*\*: left foot is .* |$'
grep -q "$row" "$page" || fail "mine does not stand or is not pushed: $(cat "$page")"
grep -q "^0 of 2 robots as expected.$" "$page" || fail "no count: $(cat "$page")"
[ -s "$TEST_TMPDIR/page/figures/robots/mine.png" ] || fail "there is no picture"
python3 - "$TEST_TMPDIR/out" << 'END' || fail "the document is: $out"
import json
import sys

document = json.load(open(sys.argv[1]))
box, mine = document['robots']
assert document['as_expected'] == 0 and document['of'] == 2
assert box['faults'] == ['is refused'] and not box['stands'], box
assert len(mine['faults']) == 2, mine['faults']
assert mine['faults'][0].startswith('left foot is '), mine['faults']
assert mine['faults'][1] == 'forward is +x, must be -x', mine['faults']
assert [p['direction_deg'] for p in mine['pushes']] == [0, 90, 180, 270]
for push in mine['pushes']:
    fraction = push['impulse_Ns'] / push['lipm_height_Ns']
    assert push['recovered'] and abs(fraction - 0.4) < 1e-9, push
assert mine['one_leg']['commanded_done']
END
echo '{"box": {"stands": false}}' > "$robots/EXPECTED.json"
run 0 --robots "$robots" --only box
echo '{"box": 3}' > "$robots/EXPECTED.json"
refuse "$robots/EXPECTED.json: robot 'box': must have stands: true or false" \
  --robots "$robots"
echo '{"ghost": {"stands": true}}' > "$robots/EXPECTED.json"
refuse "$robots/EXPECTED.json: robot 'ghost' has no URDF file in the folder, add $(
  )ghost.urdf or remove the key" --robots "$robots"

# No broken file is as expected, if EXPECTED.json does not say so.
echo '{"box": {"stands": false}}' > "$robots/EXPECTED.json"
head -c 2000 "$robots/mine.urdf" > "$robots/cut.urdf"
run 1 --robots "$robots" --only cut
grep -q '^| cut | | refused: .* | \*\*no\*\*: is refused |$' <<< "$out" || fail "cut is expected: $out"
rm "$robots/EXPECTED.json"
run 0 --robots "$robots" --only cut
echo 'feeet: {}' > "$robots/mine.yaml"
run 1 --robots "$robots" --only mine
grep -q "mine.yaml:1: .* unknown key 'feeet', .* \*\*no\*\*: its profile is refused" <<< "$out" ||
  fail "the broken profile is expected: $out"

# The folder of the page is made before the runs.
refuse "/dev/null/x: cannot be made a folder: Not a directory" \
  --robots "$robots" --out /dev/null/x
refuse "/dev/null: cannot be made a folder: Not a directory" \
  --robots "$robots" --out /dev/null
rm "$robots/cut.urdf"

# Without a profile the feet and the posture are found, as by push. Knees this
# weak cannot hold the robot.
rm "$robots/mine.urdf" "$robots/mine.yaml"
sed -e '/<joint name="._knee"/,/<\/joint>/s/effort="[^"]*"/effort="2.5"/' \
  -e 's/<robot name="humanoid"/<robot name="weak"/' \
  robot/models/humanoid.urdf > "$robots/weak.urdf"
run 1 --robots "$robots" --only weak
grep -q '^| weak | .* | \*\*falls at .*\*\* | .*\*\*no\*\*: does not stand' <<< "$out" ||
  fail "the robot with weak knees stands: $out"
echo '{"weak": {"stands": false}}' > "$robots/EXPECTED.json"
run 0 --robots "$robots" --only weak
