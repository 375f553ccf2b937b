#!/bin/bash
# Usage: push_test.sh PUSH EXPLAIN HQP
# Tests the files of an interrupted run, that both log formats have the same
# contents, and the messages about bad input.
set -euo pipefail
push=$1 explain=$2 hqp=$3

fail() {
  echo "push_test.sh: $*" >&2
  exit 1
}

# Usage: stop FOLDER SIGNAL: starts a run of an hour, waits until the log in FOLDER
# has a tenth of a second, and sends SIGNAL. Sets $code to the exit code.
stop() {
  local folder=$1 signal=$2 child
  "$push" --scenario stand --time 3600 --no-report --out "$folder" > "$folder.out" &
  child=$!
  until [ "$(wc -l 2> /dev/null < "$folder/log.csv" || echo 0)" -gt 100 ]; do
    kill -0 "$child" || fail "the run ended by itself"
    sleep 0.05
  done
  kill -s "$signal" "$child"
  code=0
  wait "$child" 2> /dev/null || code=$?
}

is_whole() {
  [ "$(tail -c 1 "$1/log.csv")" = "" ] || fail "$1: the last line of log.csv is incomplete"
  [ "$(awk -F, '{ print NF }' "$1/log.csv" | sort -u | wc -l)" = 1 ] ||
    fail "$1: not all rows of log.csv have as many cells as the header"
}

interrupted=$TEST_TMPDIR/interrupted
stop "$interrupted" INT
[ "$code" = 1 ] || fail "after SIGINT: exit code is $code, must be 1"
is_whole "$interrupted"
grep -q '"interrupted": true' "$interrupted/summary.json" ||
  fail "summary.json does not say that the run was interrupted"
grep -q '"recovered": null' "$interrupted/summary.json" ||
  fail "summary.json has an outcome for a run that was interrupted"
"$explain" "$interrupted" | grep -q 'The run was interrupted at ' ||
  fail "explain does not say that the run was interrupted"

killed=$TEST_TMPDIR/killed
stop "$killed" KILL
[ "$code" = 137 ] || fail "after SIGKILL: exit code is $code, must be 137"
# The signal can end the writing of several rows within one of them.
[ "$(head -n -1 "$killed/log.csv" | awk -F, '{ print NF }' | sort -u | wc -l)" = 1 ] ||
  fail "$killed: a row of log.csv before the last has not as many cells as the header"
"$explain" "$killed" | grep -q 'The end of the run is not recorded.' ||
  fail "explain cannot read the files of a run that was killed"

run=(--scenario strong_push --time 1.3 --no-report)
"$push" "${run[@]}" --out "$TEST_TMPDIR/csv" > /dev/null || [ $? = 1 ]
"$push" "${run[@]}" --log binary --out "$TEST_TMPDIR/binary" > /dev/null || [ $? = 1 ]
text=$(stat -c %s "$TEST_TMPDIR/csv/log.csv")
binary=$(stat -c %s "$TEST_TMPDIR/binary/log.bin")
echo "1.3 s: log.csv has $text bytes, log.bin $binary"
[ $((3 * binary)) -lt "$text" ] || fail "log.bin has $binary bytes, must be below a third of $text"
[ "$("$explain" "$TEST_TMPDIR/csv")" = "$("$explain" "$TEST_TMPDIR/binary")" ] ||
  fail "explain gives different texts for log.csv and log.bin"

# Usage: refuse MESSAGE OPTION...: push must exit with code 2 and print only the line
# MESSAGE, on stderr.
refuse() {
  local message=$1 code=0
  shift
  "$push" "$@" > "$TEST_TMPDIR/said" 2> "$TEST_TMPDIR/error" || code=$?
  [ "$code" = 2 ] || fail "$*: exit code is $code, must be 2"
  [ "$(cat "$TEST_TMPDIR/error")" = "push: $message" ] ||
    fail "$* prints: $(cat "$TEST_TMPDIR/error")"
  [ "$(wc -l < "$TEST_TMPDIR/error")" = 1 ] || fail "$* prints more than one line"
  [ ! -s "$TEST_TMPDIR/said" ] || fail "$* is rejected, but prints on stdout"
}

# Usage: write NAME LINE...: writes a file and prints its path.
write() {
  local file=$TEST_TMPDIR/$1
  shift
  printf '%s\n' "$@" > "$file"
  echo "$file"
}

# Usage: refuse_file OPTION MESSAGE NAME LINE...: push must reject a file with these
# lines. The message is the name of the file, followed by MESSAGE.
refuse_file() {
  local option=$1 message=$2 file
  shift 2
  file=$(write "$@")
  refuse "$file$message" "$option" "$file"
}

# Each of the three solvers can solve a dumped tick of the push.
"$push" --scenario strong_push --time 0.2 --dump-solve 0.1 --no-report \
  --out "$TEST_TMPDIR/dump" > "$TEST_TMPDIR/said" || [ $? = 1 ]
grep -q solve_0.100.json "$TEST_TMPDIR/said" ||
  fail "the name of the dumped solve is not printed"
for method in svd cod fast; do
  "$hqp" --method "$method" --json "$TEST_TMPDIR/dump/solve_0.100.json" \
    > "$TEST_TMPDIR/solved" || fail "hqp --method $method fails on the dumped solve"
  grep -q '"status": *"optimal"' "$TEST_TMPDIR/solved" ||
    fail "hqp --method $method does not solve the dumped solve"
done

# With the ticks before it, hqp repeats a tick that the budget cut off.
"$push" --scenario strong_push --at 0.02 --time 0.1 --budget-us 60 --dump-solve 0.09 \
  --dump-from 0 --no-report --out "$TEST_TMPDIR/ticks" > "$TEST_TMPDIR/said" || [ $? = 1 ]
grep -q -e '--max-iterations 500 --budget-us 60 .*/solves_0.000_0.090/solve_\*.json' \
  "$TEST_TMPDIR/said" ||
  fail "the names of the dumped solves are not printed"
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "status") at = i }
  NR > 1 && NR < 93 { print ($at == "truncated" ? "iteration_limit" : "optimal") }' \
  "$TEST_TMPDIR/ticks/log.csv" > "$TEST_TMPDIR/logged"
"$hqp" --budget-us 60 --json "$TEST_TMPDIR"/ticks/solves_0.000_0.090/solve_*.json \
  > "$TEST_TMPDIR/solved" || [ $? = 1 ]
grep -o '"status":"[a-z_]*"' "$TEST_TMPDIR/solved" | cut -d '"' -f 4 \
  > "$TEST_TMPDIR/repeated"
sed -n '2,92p' "$TEST_TMPDIR/ticks/timing.csv" | cut -d , -f 3 >> "$TEST_TMPDIR/logged"
grep -o '"iterations":[0-9]*' "$TEST_TMPDIR/solved" | cut -d : -f 2 \
  >> "$TEST_TMPDIR/repeated"
grep -q iteration_limit "$TEST_TMPDIR/logged" || fail "the budget cuts off no tick"
cmp "$TEST_TMPDIR/logged" "$TEST_TMPDIR/repeated" ||
  fail "hqp does not repeat the ticks with a budget"
refuse "--dump-from is 0.200000 s, must not be after --dump-solve, 0.100000 s" \
  --dump-solve 0.1 --dump-from 0.2 --no-report --out "$TEST_TMPDIR/late"

refuse "the solve at 0.200000 s is outside the scenario, which ends at $(
  )0.100000 s" --time 0.1 --dump-solve 0.2 --no-report \
  --out "$TEST_TMPDIR/late"

# A message about the value of an option names the option, not a key of a file.
refuse "--control-rate is 333, must evenly divide plant.rate, which is 1000" \
  --control-rate 333
refuse "control.rate is 1000, must evenly divide --plant-rate, which is 1500" \
  --plant-rate 1500
refuse "--time is 0, must be 0.001 to 86400 s" --time 0
refuse "--duration is -1, must be 0 to 86400 s" --duration=-1

# push prints the warnings of doctor: two weak knees give one line.
weak=$(write weak.urdf "$(sed '/<joint name="._knee"/,/<\/joint>/s/effort="[^"]*"/effort="2.5"/' \
  robot/models/humanoid.urdf)")
"$push" --robot "$weak" --scenario stand --time 0.01 --no-report \
  --out "$TEST_TMPDIR/weak" > "$TEST_TMPDIR/said" 2> "$TEST_TMPDIR/error" || true
grep -q "^$weak: joint 'l_knee': needs .* (limit 2.5 N m) to stand, the motor is too $(
  )weak for the standing posture; also joint 'r_knee'" "$TEST_TMPDIR/error" ||
  fail "there is no warning about weak knees: $(cat "$TEST_TMPDIR/error")"
[ "$(wc -l < "$TEST_TMPDIR/error")" = 1 ] || fail "the warning about weak knees has several lines"

scenarios='board, com_sinusoid, one_leg, posture_off, shove, slope, stand,'
scenarios+=' strong_push, strong_push_without_zmp, weak_push'
gone=$TEST_TMPDIR/gone.yaml
refuse "scenario 'sneeze' is unknown, must be a file or one of $scenarios" \
  --scenario sneeze
refuse "scenario '$gone' is unknown, must be a file or one of $scenarios" \
  --scenario "$gone"
refuse "$TEST_TMPDIR: cannot be read: Is a directory" --scenario "$TEST_TMPDIR"
refuse_file --scenario ":2: key 'lenght' is unknown, must be one of $(
  )name, duration, seed, chosen_for, start, steps, pushes, stance, com, tasks, control, plant, $(
  )sensors" scenario.yaml 'duration: 3' 'lenght: 4'
refuse_file --scenario ":1: 'to' is the list '[1]', must be two numbers [x, y] from -1000 to $(
  )1000 m" to.yaml 'stance: [{at: 1, step: left_foot, to: [1]}]'
refuse_file --scenario ":1: stance[0].step is 'left_foot', must come with steps: on" \
  step.yaml 'stance: [{at: 1, step: left_foot, to: [0, 0.1]}]'
refuse_file --scenario ":1: control.rate is 1000, must evenly divide $(
  )plant.rate, which is 300" rate.yaml 'plant: {rate: 300}'

refuse "$gone: cannot be read: No such file or directory" --robot "$gone"
refuse_file --robot ":2: an element is not closed, or its end tag has $(
  )another name" \
  cut.urdf '<robot name="a">' '  <link name="b">'
refuse_file --robot ":3: joint 'j': has no <limit>, must have one" \
  joint.urdf '<robot name="a"><link name="b"/><link name="c"/>' \
  '<!-- A hinge. -->' \
  '<joint name="j" type="revolute"><parent link="b"/><child link="c"/></joint>' \
  '</robot>'
refuse "$gone: cannot be read: No such file or directory" --profile "$gone"

refuse "$gone: cannot be read: No such file or directory" --pushes "$gone"
refuse_file --pushes ":3: key 'forse' is unknown, must be one of link, $(
  )point, impulse_fraction, elsewhere, frame, profile, force, moment, at, duration" \
  pushes.yaml 'pushes:' '  - force: [0, 50, 0]' '    forse: [0, 50, 0]'
refuse_file --pushes ":2: 'force' is the list '[0, fifty, 0]', must be a list of finite numbers" \
  pushes.yaml 'pushes:' '  - force: [0, fifty, 0]'
nose="link 'nose' is unknown, must be a link of robot 'humanoid'"
refuse_file --pushes ":1: $nose" pushes.yaml 'pushes: [{link: nose}]'

# If a file does not match the robot, the message names the file, and nothing is
# written.
refuse_file --scenario ":1: $nose" link.yaml 'pushes: [{link: nose}]'
refuse_file --scenario ":1: task set 'nope': is neither default, paper, nor a file" \
  tasks.yaml 'tasks: {set: nope}'
refuse_file --scenario ":1: stance: foot 'nope' is unknown, must be a foot of $(
  )robot 'humanoid': left_foot, right_foot" stance.yaml 'stance: [{at: 1, lift: nope}]'
refuse_file --scenario ":1: plant: restitution is 0.500000, must be 0 in a MuJoCo $(
  )plant" \
  bounce.yaml 'plant: {kind: mujoco, restitution: 0.5}'
refuse_file --scenario ":1: task set '$(printf 'a%.0s' {1..60})...': is neither $(
  )default, paper, nor a file" \
  long.yaml "tasks: {set: $(printf 'a%.0s' {1..300000})}"

refuse "--force is 'strong', must be a number" --force strong
refuse "the word after '--force' is empty, must have text" --force ""
refuse "'--force=' is empty, must have a value" --force= --time 2
refuse "--time is nan, must be finite" --time nan
for seed in 99999999999 -1 1.5 one; do
  refuse "--seed is '$seed', must be a whole number from 0 to 4294967295" \
    --seed "$seed"
done
refuse "--force is 1e+09, must be -1e+06 to 1e+06 N" --force 1e9
refuse "--direction is 400, must be -360 to 360 deg" --direction 400
refuse "--delay is 0.0005, must be a multiple of the plant's step" \
  --delay 0.0005
refuse "--plant is 'mars', must be bullet or mujoco" --plant mars
refuse "link 'nose' is unknown, must be a link of robot 'humanoid'" --link nose
refuse "task set 'none': is neither default, paper, nor a file" --tasks none

# A Cartesian task on any link, from wherever a task is named; one on a link that
# is not there is refused by the link.
frame="task 'frame.nose' is unknown, must be frame.LINK with a link of the robot"
refuse "$frame" --with frame.nose
refuse_file --tasks ":1: $frame" frames.yaml 'tasks: {frame.nose: on}'
refuse_file --scenario ":1: $frame" frames.yaml 'tasks: {with: [frame.nose]}'
refuse_file --profile ":1: $frame" frames.yaml 'tasks: {frame.nose: on}'

# Usage: residuals OPTION...: prints the links of the tasks frame.LINK in the log of
# a run, in the order of the columns.
residuals() {
  "$push" --scenario stand --time 0.01 --no-report \
    --out "$TEST_TMPDIR/frames" "$@" > "$TEST_TMPDIR/said" || [ $? = 1 ]
  head -n 1 "$TEST_TMPDIR/frames/log.csv" | tr , '\n' |
    sed -n '/foot$/d; s/^residual\.frame\.//p' | tr '\n' ' '
}

# Usage: expect WANTED GOT
expect() {
  [ "$1" = "$2" ] || fail "the links are '$2', must be '$1'"
}

own=$(write own.yaml "$(cat robot/profiles/humanoid.yaml)" 'tasks:' \
  '  frame.head: on')
expect 'torso ' "$(residuals --with frame.torso)"
expect 'torso l_hand ' "$(residuals \
  --tasks "$(write set.yaml 'tasks: {frame.torso: on}')" --with frame.l_hand)"
expect 'head ' "$(residuals --profile "$own")"

# The tasks of a profile apply only if no option selects a task set.
expect '' "$(residuals --profile "$own" --tasks default)"
grep -q '"set": "default"' "$TEST_TMPDIR/frames/summary.json" ||
  fail "--tasks default does not replace the tasks of the profile"
