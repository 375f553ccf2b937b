#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Tries forbidden dependencies between layers in a copy of the workspace with a
# separate output root. Fails unless the build rejects each one with the expected
# message.
set -uo pipefail

original=$(dirname "$(readlink -f WORKSPACE)")
copy=$TEST_TMPDIR/poise
mkdir -p "$copy"
tar -C "$original" --exclude=node_modules -cf - WORKSPACE BUILD .bazelrc \
  .clang-format math dynamics hqp robot sim tests tools | tar -C "$copy" -xf -
cd "$copy" || exit 1
failures=0

run_bazel() {
  bazel --output_user_root="$TEST_TMPDIR/bazel" "$@" \
    > "$TEST_TMPDIR/log" 2>&1
}

# Usage: build TARGET: compiles the sources of a library. Linking it would compile
# its dependencies too. One file does not repay the time of a precompiled header.
build() {
  run_bazel build --define=precompiled=0 --output_groups=compilation_outputs "$@"
}

# Usage: attempt WHAT WANTED COMMAND...: COMMAND must fail with an output that
# contains WANTED.
attempt() {
  local what=$1 wanted=$2
  shift 2
  if "$@"; then
    echo "NOT REJECTED: $what"
    failures=$((failures + 1))
  elif ! grep -q "$wanted" "$TEST_TMPDIR/log"; then
    echo "rejected, but without the message '$wanted': $what"
    tail -n 20 "$TEST_TMPDIR/log"
    failures=$((failures + 1))
  else
    echo "rejected: $what"
  fi
}

# Usage: add PACKAGE NAME INCLUDE [DEP]: adds a library of one header to a
# package.
add() {
  printf '#pragma once\n\n#include %s\n' "$3" > "$1/$2.h"
  printf '#include "poise/%s/%s.h"\n' "$1" "$2" > "$1/$2.cc"
  cp "$original/$1/BUILD" "$1/BUILD"
  cat > "$TEST_TMPDIR/rule" << RULE
poise_cc_library(
    name = "$2",
    srcs = ["$2.cc"],
    hdrs = ["$2.h"],
    deps = [${4:+\"$4\"}],
)

RULE
  sed -i "/^lint_test()/{
    r $TEST_TMPDIR/rule
    N
  }" "$1/BUILD"
  # lint_test() reads the existing rules, so it must stay the last line.
  sed -i '/^lint_test()/d' "$1/BUILD"
  echo 'lint_test()' >> "$1/BUILD"
}

remove() {
  rm "$1/$2.h" "$1/$2.cc"
  cp "$original/$1/BUILD" "$1/BUILD"
}

# An allowed dependency must build here, or the rejections would prove nothing.
add dynamics downward '"poise/math/so3.h"' //math:so3
if ! build //dynamics:downward; then
  echo "a downward dependency must build, but it does not:"
  tail -n 20 "$TEST_TMPDIR/log"
  exit 1
fi
remove dynamics downward

add math upward '"poise/dynamics/tree.h"' //dynamics:tree
attempt "math depends on dynamics" "not visible" build //math:upward
remove math upward

add math upward '"poise/dynamics/tree.h"'
attempt "math includes dynamics without a dependency" \
  "dynamics/tree.h: No such file\|undeclared inclusion" build //math:upward
remove math upward

add dynamics sideward '"poise/hqp/hierarchy.h"' //hqp:hierarchy
attempt "dynamics depends on hqp" "not visible" build //dynamics:sideward
remove dynamics sideward

add robot upward '"poise/robot/control/command.h"' //robot/control:command
attempt "robot depends on robot/control" "not visible" build //robot:upward
remove robot upward

add math foreign '<ceres/ceres.h>'
attempt "math includes a library that is not its own" \
  "Not a header of this layer" run_bazel test --test_output=all //math:layer_test
remove math foreign

run_bazel shutdown
[ "$failures" = 0 ]
