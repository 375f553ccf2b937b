#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Usage: tools/quality/fuzz.sh SECONDS [TARGET...]
# Runs each fuzzer of tests/fuzz (all, or urdf, profile, ...) for SECONDS, as many at
# the same time as there are processors. Their corpus is in ~/.cache/poise/fuzz, and
# the next run continues with it. An input that crashes, hangs for 30 s or takes
# 1 GiB is kept as
# ~/.cache/poise/fuzz/TARGET/crashes/*; replay it by giving the file to the
# fuzzer that the summary names. Exit code 1 if there was one, 2 for bad usage.
set -uo pipefail
cd "${BUILD_WORKSPACE_DIRECTORY:-$(dirname "$0")/../..}"

usage() {
  sed -n '3,9s/^# \?//p' tools/quality/fuzz.sh >&2
  exit 2
}
[[ ${1:-} =~ ^[1-9][0-9]*$ ]] || usage
seconds=$1
shift
mapfile -t all < <(sed -n 's/^    name = "\(.*\)_fuzzer",/\1/p' tests/fuzz/BUILD)
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")
labels=()
for target in "${targets[@]}"; do
  if [[ " ${all[*]} " != *" $target "* ]]; then
    echo "tools/quality/fuzz.sh: no fuzzer '$target', want one of: ${all[*]}" >&2
    exit 2
  fi
  labels+=("//tests/fuzz:${target}_fuzzer")
done

home=${POISE_FUZZ:-$HOME/.cache/poise/fuzz}
mkdir -p "$home"
bazel=(bazel "--output_base=$home/output")
# The user's //... would follow links to this output base.
"${bazel[@]}" build --config=fuzz --noshow_progress \
  --experimental_convenience_symlinks=ignore "${labels[@]}" || exit 1
bin=$("${bazel[@]}" info --config=fuzz bazel-bin 2> /dev/null)/tests/fuzz
"${bazel[@]}" shutdown

# Usage: fuzz TARGET: runs a fuzzer and prints its row of the table, and what it
# found.
fuzz() {
  local target=$1
  local folder=$home/$target
  mkdir -p "$folder/corpus" "$folder/crashes"
  local arguments=(-max_total_time="$seconds" -timeout=30 -rss_limit_mb=2048
    -malloc_limit_mb=1024 -print_final_stats=1
    -artifact_prefix="$folder/crashes/")
  # In CI the seed is fixed, so that the result depends on the change only.
  [ -n "${CI:-}" ] && arguments+=(-seed=1)
  local dictionary=tests/fuzz/dictionaries/$target.txt
  [ -f "$dictionary" ] && arguments+=(-dict="$dictionary")
  local seeds=()
  [ -d "tests/fuzz/seeds/$target" ] && seeds+=("tests/fuzz/seeds/$target")
  # POISE_SHARED names a folder of data that is not in the repository.
  local hostile=${POISE_SHARED:-}/${target}_hostile
  [ -n "${POISE_SHARED:-}" ] && [ -d "$hostile" ] && seeds+=("$hostile")
  ASAN_OPTIONS=detect_leaks=1 "$bin/${target}_fuzzer" "${arguments[@]}" \
    "$folder/corpus" "${seeds[@]}" > "$folder/log" 2>&1
  local status=$? crashes
  crashes=$(find "$folder/crashes" -type f | wc -l)
  printf '%-10s %12s %9s %9s %9s\n' "$target" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/log")" \
    "$(find "$folder/corpus" -type f | wc -l)" \
    "$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$folder/log" | tail -n 1)" \
    "$crashes"
  [ "$status" = 0 ] && [ "$crashes" = 0 ] && return
  echo "  replay: $bin/${target}_fuzzer $folder/crashes/*"
  grep -m 3 -E '^(==[0-9]+==)?ERROR|does not hold|SUMMARY|runtime error' \
    "$folder/log" | sed 's/^/  /' || tail -n 5 "$folder/log" | sed 's/^/  /'
}

printf '%-10s %12s %9s %9s %9s\n' fuzzer runs corpus coverage crashes
for target in "${targets[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n; done
  mkdir -p "$home/$target"
  fuzz "$target" > "$home/$target/summary" &
done
wait
failures=0
for target in "${targets[@]}"; do
  cat "$home/$target/summary"
  if grep -q '^  replay: ' "$home/$target/summary"; then
    failures=$((failures + 1))
  fi
done
[ "$failures" = 0 ]
