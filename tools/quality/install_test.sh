#!/bin/bash
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
# Usage: tools/quality/install_test.sh [--quick] [--layers LAYERS] [NAME...]
# Installs Poise into a temporary folder and checks the installation: symbols,
# headers, programs built by CMake and pkg-config, Poise as a folder of another
# CMake project, rollback, uninstallation.
#   --quick  compiles each header alone with g++ in C++17, and all headers together
#            with clang and in C++20
#   --layers LAYERS  installs these layers only, for checks that need no others
#   NAME     runs the checks of this name only, as SymbolsTest or SymbolsTest.NAME
# Needs the packages of tools/setup.sh --package. Exit code: 0 if all is well, 1 if
# a check failed, 2 for bad input.
set -euo pipefail
cd "$(dirname "$0")/../.."

names=()
layers=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      sed -n '3,13s/^# \?//p' "$0"
      exit 0
      ;;
    --quick) export POISE_QUICK=1 ;;
    --layers)
      layers=(--layers "${2:-}")
      export POISE_LAYERS=${2:-}
      [ $# -lt 2 ] || shift
      ;;
    -*)
      echo "install_test: unknown option '$1', must be --quick or --layers" >&2
      exit 2
      ;;
    *) names+=("$1") ;;
  esac
  shift
done
for program in cmake clang++ g++ pkg-config readelf; do
  command -v "$program" > /dev/null || {
    echo "install_test: no $program on PATH; run tools/setup.sh --package" >&2
    exit 2
  }
done

POISE_WORK=$(mktemp -d)
export POISE_WORK
trap 'rm -rf "$POISE_WORK"' EXIT
bazel run //tools:install -- --prefix "$POISE_WORK/prefix" "${layers[@]}" || exit 1
if ! python3 tests/install/install_checks.py "${names[@]}"; then exit 1; fi
