#!/bin/bash
# Usage: push_test.sh PUSH EXPLAIN
# What a run leaves when it is stopped, and that its two logs say the same.
set -euo pipefail
push=$1 explain=$2

fail() {
  echo "push_test.sh: $*" >&2
  exit 1
}

# Starts a run of an hour, waits for a tenth of a second of it in FOLDER, and
# sends SIGNAL. Sets $code to how it ended.
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
  [ "$(tail -c 1 "$1/log.csv")" = "" ] || fail "$1: the last line is cut"
  [ "$(awk -F, '{ print NF }' "$1/log.csv" | sort -u | wc -l)" = 1 ] ||
    fail "$1: not all rows are as long as the header"
}

interrupted=$TEST_TMPDIR/interrupted
stop "$interrupted" INT
[ "$code" = 1 ] || fail "exit code $code after SIGINT, wanted 1"
is_whole "$interrupted"
grep -q '"interrupted": true' "$interrupted/summary.json" ||
  fail "summary.json does not say that the run was interrupted"

killed=$TEST_TMPDIR/killed
stop "$killed" KILL
[ "$code" = 137 ] || fail "exit code $code after SIGKILL, wanted 137"
is_whole "$killed"
"$explain" "$killed" | grep -q 'How it ended is not recorded.' ||
  fail "explain does not read what a kill left"

run=(--scenario strong_push --time 1.3 --no-report)
"$push" "${run[@]}" --out "$TEST_TMPDIR/csv" > /dev/null || [ $? = 1 ]
"$push" "${run[@]}" --log binary --out "$TEST_TMPDIR/binary" > /dev/null || [ $? = 1 ]
text=$(stat -c %s "$TEST_TMPDIR/csv/log.csv")
binary=$(stat -c %s "$TEST_TMPDIR/binary/log.bin")
echo "1.3 s: log.csv has $text bytes, log.bin $binary"
[ $((3 * binary)) -lt "$text" ] || fail "log.bin is not compact"
[ "$("$explain" "$TEST_TMPDIR/csv")" = "$("$explain" "$TEST_TMPDIR/binary")" ] ||
  fail "the two logs do not say the same"

code=0
"$push" --time nan 2> "$TEST_TMPDIR/error" || code=$?
[ "$code" = 2 ] || fail "exit code $code for --time nan, wanted 2"
[ "$(cat "$TEST_TMPDIR/error")" = "push: --time: is nan, must be finite" ] ||
  fail "--time nan says: $(cat "$TEST_TMPDIR/error")"
