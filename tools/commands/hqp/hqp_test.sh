#!/bin/bash
# Usage: hqp_test.sh HQP DYNAMICS URDF PAGE
# Checks what scripts rely on: exit codes, and one line on stderr that names the
# file.
set -euo pipefail
hqp=$PWD/$1 dynamics=$PWD/$2 urdf=$PWD/$3 page=$PWD/$4
cd "$TEST_TMPDIR"

fail() {
  echo "hqp_test.sh: $*" >&2
  exit 1
}

# Usage: refuse MESSAGE COMMAND...: the command must exit with code 2 and print
# only this line, on stderr.
refuse() {
  local message=$1 code=0
  shift
  timeout 60 "$@" > said 2> error || code=$?
  [ "$code" = 2 ] || fail "$*: exit code is $code, must be 2"
  [ "$(cat error)" = "$message" ] || fail "$* prints: $(cat error)"
  [ ! -s said ] || fail "$* is rejected, but prints on stdout: $(cat said)"
}

echo '{"format": "hqp-1", "variables": 1, "levels": [{"B": [[2]], "b": [-4]}]}' \
  > good.json
"$hqp" --json good.json > said 2> error || fail "exit code $? for good.json"
grep -q '"status":"optimal","y":\[2.0\]' said || fail "good.json prints: $(cat said)"
[ ! -s error ] || fail "a good file prints on stderr: $(cat error)"

# The file of the page, and the answer that the page gives.
sed -n '/^```json$/,/^```$/p' "$page" | grep -v '```' > page.json
"$hqp" --json page.json > said || fail "exit code $? for the file of $page"
answer=$(sed -n 's/.*The answer is `y = \[\([0-9]*\), \([0-9]*\)\]`.*/\1 \2/p' "$page")
[ -n "$answer" ] || fail "$page gives no answer"
sed -n 's/.*"y":\[\([^]]*\)\].*/\1/p' said | awk -F, -v wanted="$answer" '
  { split(wanted, y, " "); for (i in y) if (($i - y[i])^2 > 1e-24) exit 1 }
  END { if (NR != 1) exit 1 }' || fail "the file of $page prints: $(cat said)"

# y >= 3 above y = 0 takes two iterations: the first finds the violated bound, the
# second has the bound in the working set.
echo '{"format": "hqp-1", "variables": 1, "levels": [
  {"C": [[1]], "lower": [3], "upper": [9]}, {"B": [[1]], "b": [0]}]}' > two.json
"$hqp" --json two.json > said || fail "exit code $? for two.json"
code=0
"$hqp" --json --max-iterations 1 two.json > said || code=$?
[ "$code" = 1 ] || fail "one iteration: exit code is $code, must be 1"
grep -q '"status":"iteration_limit"' said || fail "one iteration: $(cat said)"

refuse "hqp: --budget-us is nan, must be 0 to 1e+06 us" "$hqp" --budget-us nan good.json
refuse "hqp: --budget-us is 2e+06, must be 0 to 1e+06 us" \
  "$hqp" --budget-us 2e6 good.json
refuse "hqp: --budget-us has an effect with --method fast only, but --method is svd" \
  "$hqp" --method svd --budget-us 100 good.json
"$hqp" --json --method svd --cold --max-iterations 9 good.json > said 2> error ||
  fail "exit code $? for svd with a limit of iterations"
[ "$(cat error)" = "hqp: --max-iterations has an effect with --method fast only, $(
  )but --method is svd, ignored" ] || fail "svd prints: $(cat error)"

# Several files are ticks of one solver, and a solve starts from the working set of
# the previous file. So one iteration is enough for the second file, even if the file
# has one row fewer. With --cold, or after a file with another number of variables, the
# solver starts anew.
echo '{"format": "hqp-1", "variables": 1, "levels": [
  {"C": [[1]], "lower": [4]}]}' > after.json
echo '{"format": "hqp-1", "variables": 2, "levels": [
  {"B": [[1, 0], [0, 1]], "b": [-1, -2]}]}' > wide.json
# Usage: iterations COUNTS ARGUMENTS...: the files must take these numbers of
# iterations.
iterations() {
  local wanted=$1 got
  shift
  "$hqp" --json "$@" > said || fail "exit code $? for $*"
  got=$(grep -o '"iterations":[0-9]*' said | cut -d: -f2 | tr '\n' ' ')
  [ "$got" = "$wanted " ] || fail "$*: iterations are $got, must be $wanted"
  [ "$(head -c 1 said)" = "[" ] || fail "$*: the output is not an array: $(cat said)"
}
iterations "2 1 1" two.json two.json after.json
grep -q '"y":\[3.0\].*"y":\[3.0\].*"y":\[4.0\]' said ||
  fail "ticks have wrong solutions: $(cat said)"
iterations "2 2 2" --cold two.json two.json after.json
iterations "2 1 2 1" two.json wide.json two.json two.json
iterations "1 1" good.json good.json
"$hqp" two.json two.json > said || fail "exit code $? for ticks"
[ "$(grep -c '^two.json: optimal, ' said)" = 2 ] || fail "ticks: $(cat said)"
"$hqp" --json --method svd two.json wide.json > said || fail "exit code $? for svd"
code=0
"$hqp" --json --max-iterations 1 good.json two.json > said || code=$?
[ "$code" = 1 ] || fail "one iteration of ticks: exit code is $code, must be 1"

echo '{"format": "hqp-1", "variables": 1, "levels": [
  {"C": [[1]], "lower": [2], "upper": [1]}]}' > crossed.json
refuse "hqp: crossed.json: levels[0].lower[0]: is 2, must not be above $(
  )upper[0], 1" "$hqp" --json good.json crossed.json

refuse "hqp: /tmp: cannot be read: Is a directory" "$hqp" /tmp
refuse "hqp: /dev/zero: is not a regular file" "$hqp" /dev/zero
refuse "hqp: gone.json: cannot be read: No such file or directory" "$hqp" gone.json
refuse "hqp: option '--foo' is unknown" "$hqp" --foo
refuse "hqp: option '--foo' is unknown" "$hqp" --foo good.json
refuse "hqp: files is missing, see --help" "$hqp"

refuse "dynamics: /dev/zero: is not a regular file" \
  "$dynamics" --urdf "$urdf" --states /dev/zero
refuse "dynamics: option '--foo' is unknown" "$dynamics" --foo

# The last link has no <inertial>, so M is singular. M is printed anyway.
cat > leaf.urdf << 'EOF'
<robot name="leaf">
  <link name="base"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="tip"/>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="tip"/>
    <limit effort="1" velocity="1"/></joint>
</robot>
EOF
echo '{"joints": ["hinge"], "states": []}' > states.json
"$dynamics" --urdf leaf.urdf --states states.json --json > said 2> error ||
  fail "exit code $? for a leaf without mass"
[ "$(cat error)" = "dynamics: warning: leaf.urdf: joint 'hinge': moves no mass $(
  )(link 'tip' and beyond), M is singular or indefinite: $(
  )no acceleration can be computed" ] ||
  fail "dynamics prints for a leaf without mass: $(cat error)"
echo '[]' > list.json
refuse "dynamics: list.json: is [], must be an object with the keys joints and states" \
  "$dynamics" --urdf leaf.urdf --states list.json
refuse "dynamics: good.json: document: has no key 'joints'" \
  "$dynamics" --urdf leaf.urdf --states good.json
