#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Usage: tools/quality/package_test.sh [--cache DIR] [STEP...]
# Tries each way to get Poise in a root folder of its own with a bare Debian 12,
# without the checkout. Prints the time of each step, then "N passed, N failed".
#   --cache DIR  keeps the bare Debian and downloaded packages in DIR
#                (default: ~/.cache/poise)
#   STEP         runs these steps only, of:
#     lintian        Debian's checks of the packages
#     deb_cmake      libpoise-dev, and a CMake project with RNEA of a URDF
#     deb_python     python3-poise, and a push in 15 lines
#     wheel          the wheel, and the same push, without compilers
#     fetch_content  FetchContent of a clone, which calls Bazel
#     colcon         colcon build of a clone and of a package that needs it
# deb_cmake and deb_python must also leave nothing behind when the packages are
# removed.
# Needs root, and the packages of tools/setup.sh --package. Exit code: 0 if all
# is well, 1 if a step failed, 2 for bad input.
set -euo pipefail
cd "$(dirname "$0")/../.."

fail() {
  echo "package_test: $1" >&2
  exit 2
}

cache=${XDG_CACHE_HOME:-$HOME/.cache}/poise
all=(lintian deb_cmake deb_python wheel fetch_content colcon)
steps=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      sed -n '3,19s/^# \?//p' "$0"
      exit 0
      ;;
    --cache)
      [ -n "${2:-}" ] || fail "--cache has no value, must be a folder"
      cache=$(realpath -m "$2")
      shift
      ;;
    *)
      [[ " ${all[*]} " == *" $1 "* ]] ||
        fail "'$1' is not a step, must be of ${all[*]}, or --cache DIR"
      steps+=("$1")
      ;;
  esac
  shift
done
[ ${#steps[@]} -gt 0 ] || steps=("${all[@]}")
[ "$(id -u)" = 0 ] || fail "needs root, for chroot and mount; use sudo"
for program in bazel lintian mmdebstrap unshare; do
  command -v "$program" > /dev/null ||
    fail "no $program on PATH; run tools/setup.sh --package"
done

work=$(mktemp -d)
child=
# The steps mount inside a namespace of their own, which ends with them. So no
# mount and no process is left, however they end, and the folder can be removed.
# Their processes need a moment to end.
trap 'rm -rf "$work" 2> /dev/null || { sleep 2; rm -rf "$work"; }' EXIT
stop() {
  if [ -n "$child" ]; then
    kill "$child"
    wait "$child" || true
  fi
  exit 130
}
trap stop INT TERM HUP

bazel build --config=opt //tools/package:deb //python:wheel || exit 1
mkdir -p "$work/built" "$cache/archives/partial"
cp bazel-bin/tools/package/*.deb bazel-bin/python/*.whl "$work/built"
bare=$cache/bookworm.tar
if [ ! -f "$bare" ]; then
  echo "package_test: making a bare Debian 12, kept in $bare"
  mmdebstrap --quiet --variant=minbase bookworm "$work/bookworm.tar" || {
    echo "package_test: mmdebstrap failed; its messages are above" >&2
    exit 1
  }
  mv "$work/bookworm.tar" "$bare"
fi
unshare --mount --pid --fork --kill-child --mount-proc \
  tests/install/package_checks.sh "$work" "$cache" "${steps[@]}" &
child=$!
wait "$child"
