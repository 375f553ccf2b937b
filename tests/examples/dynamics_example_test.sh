#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Loads the dynamics example in its own workspace and runs it. Fails if energy or
# momentum change, or if the example loads a library above the dynamics. The
# program that runs is built in this workspace, because the example's workspace
# would compile all of the dynamics again. POISE_WHOLE_EXAMPLE=1, which .ci/run
# sets, builds it there, and the other two examples
# in their own workspaces.
set -euo pipefail

simulate=$PWD/tests/examples/simulate
tree=$(dirname "$(readlink -f WORKSPACE)")
for example in arm_reach dynamics quadruped; do
  cp -r "$tree/docs/examples/$example" "$TEST_TMPDIR"
  sed -i "s|path = \"../../..\"|path = \"$tree\"|" \
    "$TEST_TMPDIR/$example/WORKSPACE"
done
cd "$TEST_TMPDIR/dynamics"
run_bazel() {
  bazel --output_user_root="$TEST_TMPDIR/bazel" --max_idle_secs=60 "$@"
}
trap 'run_bazel shutdown > /dev/null 2>&1' EXIT

# Compiles as quickly as the workspace around it, see its .bazelrc. The two
# workspaces share what they compile.
quick=(--copt=-Og --copt=--param=ggc-min-heapsize=524288
  --strategy=CppCompile=local "--disk_cache=$TEST_TMPDIR/built")
build() {
  run_bazel build "${quick[@]}" "$@" > log 2>&1 || { tail -n 30 log; exit 1; }
}
if [ -n "${POISE_WHOLE_EXAMPLE:-}" ]; then
  # Usage: runs EXAMPLE TEXT: builds the example; it prints the text.
  runs() {
    cd "$TEST_TMPDIR/$1"
    build "//:$1"
    "bazel-bin/$1" | tee output
    grep -q "$2" output
    run_bazel shutdown
  }
  runs quadruped "weight 147.150 N"
  runs arm_reach "error .* m"
  cd "$TEST_TMPDIR/dynamics"
  build //:simulate
  simulate=bazel-bin/simulate
else
  build --nobuild //:simulate
  # One library shows that the workspace compiles. This one is quick: it includes
  # Eigen and a header of Poise, but no decomposition.
  build @poise//math:rpy
fi
loaded=$(ls "$(run_bazel info output_base 2> /dev/null)/external")
if ! grep -qx poise <<< "$loaded" ||
    grep -xE 'urdfdom|bullet|ceres|mujoco|openssl|yaml_cpp' <<< "$loaded"; then
  echo "the example must load only poise and Eigen, but it loaded: $loaded"
  exit 1
fi
"$simulate" | tee output

# The energies of each system must agree to 1e-4. The center of mass of the chain
# falls freely: its second differences over 0.5 s are (0, 0, -9.81 / 4), up to
# rounding in the third decimal.
awk '
function size(x) { return x < 0 ? -x : x }
{
  energy = $(NF - 1)
  if (!($1 in first)) first[$1] = energy
  drift = size(energy - first[$1])
  if (drift > 1e-4 * (size(first[$1]) + 10)) {
    print $1 ": energy drifts by " drift " J"; bad = 1
  }
  rows++
}
/floating/ {
  for (i = 0; i < 3; ++i) {
    x = $(9 + i)
    bend = x - 2 * last[i] + before[i] + (i == 2 ? 9.81 / 4 : 0)
    if (falling > 1 && size(bend) > 3e-3) {
      print "the center of mass misses free fall by " bend " m"; bad = 1
    }
    before[i] = last[i]; last[i] = x
  }
  falling++
}
END { exit bad || rows != 10 || falling != 5 }' output
