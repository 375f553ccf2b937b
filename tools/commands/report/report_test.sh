#!/bin/bash
# Usage: report_test.sh REPORT EXPLAIN
# Tests that report keeps the files of a run, and its messages about bad input.
set -euo pipefail
report=$PWD/$1 explain=$PWD/$2
cd "$TEST_TMPDIR"

fail() {
  echo "report_test.sh: $*" >&2
  exit 1
}

# Usage: expect CODE MESSAGE ARGUMENT...: report must exit with CODE and print only
# the line MESSAGE on stderr; nothing if MESSAGE is empty.
expect() {
  local wanted=$1 message=$2 code=0
  shift 2
  "$report" "$@" > out 2> err || code=$?
  [ "$code" = "$wanted" ] || fail "$*: exit code is $code, must be $wanted: $(cat err)"
  [ "$(cat err)" = "$message" ] || fail "$* prints: $(cat err)"
}

mkdir run
printf 'time[s],com.x[m]\n0,0\n0.001,0\n' > run/log.csv
echo '{"recovered": true, "control_dt": 0.001}' > run/summary.json
echo '{}' > run/robot.json
expect 0 '' run
[ -s run/report.html ] || fail "there is no report.html"

# The page must not replace a file of the run.
cp -r run kept
ln -s run link
for name in run/log.csv run/./summary.json link/robot.json; do
  expect 2 "report: $name: is $(basename "$name") of a run and would be replaced, $(
    )choose another name" run --out "$name"
  expect 2 "report: $name: is $(basename "$name") of a run and would be replaced, $(
    )choose another name" kept run --out "$name"
done
diff -r run kept || fail "a file of the run was replaced"
expect 0 '' run --out page.html

# A missing file is noted; a broken one is refused.
rm kept/robot.json
expect 0 "report: $PWD/kept: robot.json is missing." "$PWD/kept"
echo '{"recovered": tr' > kept/summary.json
expect 2 'report: kept/summary.json:1:17: is not JSON: the file ends too early; run push again, or remove this file to read the log alone' kept

# Both programs that read a run say the same if they do not get its folder.
for program in "$report" "$explain"; do
  for given in 'nodir: does not exist' 'run/log.csv: is a file'; do
    code=0
    "$program" "${given%%:*}" > out 2> err || code=$?
    [ "$code" = 2 ] || fail "$program ${given%%:*}: exit code is $code, must be 2"
    [ "$(cat err)" = "$(basename "$program"): $given, give the folder of a run, not its log" ] ||
      fail "$program prints: $(cat err)"
  done
done
