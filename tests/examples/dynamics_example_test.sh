#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Builds the example of the dynamics in a workspace of its own, runs it, and
# fails unless energy and momentum stay and nothing above the dynamics is loaded.
set -euo pipefail

example=$(dirname "$(readlink -f WORKSPACE)")/docs/examples/dynamics
copy=$TEST_TMPDIR/dynamics
cp -r "$example" "$copy"
sed -i "s|path = \"../../..\"|path = \"${example%/docs/examples/dynamics}\"|" \
  "$copy/WORKSPACE"
cd "$copy"
run_bazel() {
  bazel --output_user_root="$TEST_TMPDIR/bazel" "$@"
}
trap 'run_bazel shutdown > /dev/null 2>&1' EXIT

if run_bazel query --noimplicit_deps 'deps(//:simulate)' 2> /dev/null |
    grep -E '@(urdfdom|bullet|ceres|mujoco)//'; then
  echo "these should not be needed"
  exit 1
fi
run_bazel build //:simulate > log 2>&1 || { tail -n 30 log; exit 1; }
bazel-bin/simulate | tee output

# The energies of each system, first and last, must agree to a part in 1e4.
awk '{
  name = $1; energy = $(NF - 1)
  if (!(name in first)) first[name] = energy
  drift = energy - first[name]; if (drift < 0) drift = -drift
  size = first[name] < 0 ? -first[name] : first[name]
  if (drift > 1e-4 * (size + 10)) { print name " drifts by " drift; bad = 1 }
  rows++
} END { exit bad || rows != 10 }' output
