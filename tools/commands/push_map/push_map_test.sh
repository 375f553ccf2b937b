#!/bin/bash
# Usage: push_map_test.sh PUSH_MAP
# Tests that a map is the same if computed at once, in shards, or with an
# interruption. The runs are too short to be results about the robot.
set -euo pipefail
push_map=$1

fail() {
  echo "push_map_test.sh: $*" >&2
  exit 1
}

small=(--step 8 --at 0.02 --time 0.63 --jobs 1 --no-replays)

# Usage: map FOLDER OPTION...: computes a map in FOLDER.
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

# A map of very many directions is stopped once a push was tried. The next command
# continues it with the two directions of the whole map.
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
[ "$code" = 1 ] || fail "after SIGINT: exit code is $code, must be 1"
grep -q 'run the same command again to continue' "$cut.err" ||
  fail "after SIGINT it prints: $(cat "$cut.err")"
map cut --directions 2
while read -r row; do
  grep -qxF -- "$row" "$cut/map.csv" || fail "the continued map has no row $row"
done < "$whole"
[ -z "$(sort "$cut/trials.csv" | uniq -d)" ] || fail "a push was tried twice"

# A second set of tasks is added to the same map. Other settings are rejected.
map whole --directions 2 --without cop,yaw --with yaw_constant
[ "$(grep -c -- ',-cop-yaw+yaw_constant,' "$whole")" = 2 ] ||
  fail "the second set of tasks is not in $(cat "$whole")"

# A rejected command leaves no map, so that the corrected command can use the folder.
code=0
map fresh --directions 1 --with foo 2> "$TEST_TMPDIR/error" || code=$?
[ "$code" = 2 ] || fail "--with foo: exit code is $code, must be 2"
grep -q "^push_map: task 'foo' is unknown" "$TEST_TMPDIR/error" ||
  fail "--with foo prints: $(cat "$TEST_TMPDIR/error")"
[ ! -e "$TEST_TMPDIR/fresh" ] || fail "--with foo leaves $(ls "$TEST_TMPDIR/fresh")"
map fresh --directions 1 --mu-plant 0.5

# Usage: refuse MESSAGE OPTION...: push_map must exit with code 2 and MESSAGE.
refuse() {
  local message=$1 code=0
  shift
  map whole "$@" 2> "$TEST_TMPDIR/error" || code=$?
  [ "$code" = 2 ] || fail "$*: exit code is $code, must be 2"
  [ "$(cat "$TEST_TMPDIR/error")" = "push_map: $message" ] ||
    fail "$* prints: $(cat "$TEST_TMPDIR/error")"
}

refuse "$TEST_TMPDIR/whole: has a map with other settings, see settings.txt; $(
  )choose another --out" --mu-plant 0.5
refuse "task 'cop' is in --with and in --without, must be in one of them" \
  --with cop --without cop
refuse "--shard is '3/2', must be I/N with 1 <= I <= N" --shard 3/2
refuse "--force=50 cannot be used here: push_map sets scenario, direction, $(
  )duration and force itself" --force=50
refuse "--durations is '0', must be 0.001 to 10 s" --durations 0
refuse "--durations has 0.2 s, and a run lasts 0.63 s, must last at least 0.72 s: $(
  )the outcome is known 0.5 s after the push; give --time" --durations 0.2
refuse "--point: the push is below the soles, must be above them, because the $(
  )search starts at the pendulum's bound" --point=0,0,-5
