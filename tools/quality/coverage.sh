#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Usage: tools/quality/coverage.sh [TARGET...]
# Measures the lines and branches of math, dynamics, hqp and robot that the tests
# (all, or TARGET...) run, with GCC's --coverage, and lists uncovered lines. Exit
# code 1 if a layer has less than 97 % of its lines, or a test fails. Builds in
# a separate output base, ~/.cache/poise/coverage.
set -uo pipefail
cd "${BUILD_WORKSPACE_DIRECTORY:-$(dirname "$0")/../..}"
case ${1:-} in
  -h | --help)
    sed -n '3,7s/^# \?//p' tools/quality/coverage.sh
    exit 0
    ;;
esac
targets=("$@")
# //... would follow the bazel-* links of another output base.
[ ${#targets[@]} -gt 0 ] ||
  targets=(//math/... //dynamics/... //hqp/... //robot/... //sim/... //tests/... //tools/...)

home=${POISE_COVERAGE:-$HOME/.cache/poise/coverage}
mkdir -p "$home"
bazel=(bazel "--output_base=$home/output")
flags=()
if [ -n "${POISE_SHARED:-}" ]; then flags+=(--test_env=POISE_SHARED); fi
rm -rf "$home/counters"
"${bazel[@]}" test --config=coverage --noshow_progress --keep_going \
  --experimental_convenience_symlinks=ignore \
  --test_env=GCOV_PREFIX="$home/counters" --test_env=GCOV_PREFIX_STRIP=3 \
  "${flags[@]}" "${targets[@]}"
status=$?
root=$("${bazel[@]}" info execution_root 2> /dev/null)
"${bazel[@]}" shutdown
python3 tools/quality/coverage_report.py "$root" "$home/counters" math dynamics hqp robot || status=1
exit $status
