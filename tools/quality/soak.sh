#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Usage: tools/quality/soak.sh HOURS [TARGET...]
# Runs the property tests (all that use RapidCheck, or TARGET...) repeatedly, with
# new seeds and ten times as many cases as the default run. Each failure is kept as a
# file in ~/.cache/poise/soak with the replay command and the output of the test. Exit
# code 1 after a failure; Bazel's exit code, at once, if the build fails.
set -uo pipefail
cd "${BUILD_WORKSPACE_DIRECTORY:-$(dirname "$0")/../..}"
if ! [[ ${1:-} =~ ^[0-9]*\.?[0-9]+$ ]]; then
  sed -n '3,9s/^# \?//p' tools/quality/soak.sh >&2
  exit 2
fi
end=$(awk -v hours="$1" 'BEGIN { printf "%d", systime() + 3600 * hours }')
shift
targets=("$@")
if [ ${#targets[@]} = 0 ]; then
  mapfile -t targets < <(bazel query --noshow_progress \
    'kind("cc_test rule", rdeps(//..., @rapidcheck//:rapidcheck))' 2> /dev/null)
fi
home=${POISE_SOAK:-$HOME/.cache/poise/soak}
mkdir -p "$home"
log=$(mktemp)
trap 'rm -f "$log"' EXIT

rounds=0 failures=0
while [ "$(date +%s)" -lt "$end" ]; do
  seed=$((RANDOM << 15 | RANDOM))
  parameters="seed=$seed max_success=1000"
  bazel test --noshow_progress --keep_going --test_output=errors \
    --test_timeout=3600 --test_env=RC_PARAMS="$parameters" "${targets[@]}" \
    > "$log" 2>&1
  status=$?
  rounds=$((rounds + 1))
  while read -r target; do
    failures=$((failures + 1))
    file=$home/$(date +%Y%m%d-%H%M%S)$(tr '/:' '__' <<< "$target").txt
    {
      echo "bazel test --test_env=RC_PARAMS=\"$parameters\" $target"
      sed -n "/Test output for ${target//\//\\/}:/,/^=====*$/p" "$log"
    } > "$file"
    echo "failed: $target; replay by the first line of $file"
  done < <(sed -n 's/^\(\/\/[^ ]*\) .*\(FAILED\|TIMEOUT\) in .*/\1/p' "$log")
  if [ "$status" != 0 ] && [ "$status" != 3 ]; then
    cat "$log" >&2  # Something does not build: that is no clean round.
    exit "$status"
  fi
  echo "round $rounds, seed $seed: $failures failures so far"
done
[ "$failures" = 0 ]
