#!/bin/bash
# Usage: push_map_test.sh PUSH_MAP
# A map in one go, in shards, and interrupted is the same map. Its runs are cut
# short, and so say nothing of the robot.
set -euo pipefail
push_map=$1

fail() {
  echo "push_map_test.sh: $*" >&2
  exit 1
}

small=(--step 8 --at 0.02 --time 0.1 --jobs 1 --no-replays)

# Usage: map FOLDER OPTION...
map() {
  local folder=$TEST_TMPDIR/$1
  shift
  "$push_map" "${small[@]}" --out "$folder" "$@" > "$folder.out"
}

map whole --directions 2
whole=$TEST_TMPDIR/whole/map.csv
[ "$(head -1 "$whole")" = \
  direction_deg,duration_s,tasks,impulse_Ns,lipm_Ns,lipm_height_Ns,eta ] ||
  fail "the header is $(head -1 "$whole")"
[ "$(cut -d, -f1-3 "$whole" | tail -n +2)" = "0,0.1,default
180,0.1,default" ] || fail "the points are $(cat "$whole")"
grep -q poise-map-1 "$TEST_TMPDIR/whole/map.html" || fail "map.html has no map"

map first --directions 2 --shard 1/2
map second --directions 2 --shard 2/2
cat "$TEST_TMPDIR"/{first,second}/map.csv | sort | cmp - <(sort "$whole") ||
  fail "the shards do not join to the map"

# A map of very many directions, stopped once a push was tried: it is gone on
# with, here to the few that the whole one has.
cut=$TEST_TMPDIR/cut
"$push_map" "${small[@]}" --directions 3600 --out "$cut" > "$cut.out" \
  2> "$cut.err" &
child=$!
until [ "$(wc -l 2> /dev/null < "$cut/trials.csv" || echo 0)" -gt 1 ]; do
  kill -0 "$child" || fail "the map ended by itself"
  sleep 0.05
done
kill -INT "$child"
code=0
wait "$child" || code=$?
[ "$code" = 1 ] || fail "exit code $code after SIGINT, wanted 1"
grep -q 'the same command goes on' "$cut.err" ||
  fail "it says: $(cat "$cut.err")"
map cut --directions 2
while read -r row; do
  grep -qxF -- "$row" "$cut/map.csv" || fail "gone on with, it lacks $row"
done < "$whole"
[ -z "$(sort "$cut/trials.csv" | uniq -d)" ] || fail "a push was tried twice"

# A second set of tasks goes into the same map; other settings do not.
map whole --directions 2 --without cop,yaw --with yaw_constant
[ "$(grep -c -- ',-cop-yaw+yaw_constant,' "$whole")" = 2 ] ||
  fail "the second set is not in $(cat "$whole")"

# Usage: refuse MESSAGE OPTION...
refuse() {
  local message=$1 code=0
  shift
  map whole "$@" 2> "$TEST_TMPDIR/error" || code=$?
  [ "$code" = 2 ] || fail "exit code $code for $*, wanted 2"
  [ "$(cat "$TEST_TMPDIR/error")" = "push_map: $message" ] ||
    fail "$* says: $(cat "$TEST_TMPDIR/error")"
}

refuse "$TEST_TMPDIR/whole: holds a map of other settings (settings.txt); $(
  )choose another --out" --mu-plant 0.5
refuse "--shard is '3/2', must be I/N with 1 <= I <= N" --shard 3/2
refuse "--force=50 is not for a map: it varies direction, duration and $(
  )force itself" --force=50
refuse "--durations: '0' must be 0.001 to 10 s" --durations 0
