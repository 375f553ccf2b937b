#!/bin/bash
# Usage: format_test.sh SOURCE...
# Fails if clang-format would change a SOURCE.
set -eu
if ! command -v clang-format > /dev/null; then
  echo "clang-format is not installed: run tools/setup.sh" >&2
  exit 1
fi
# Runfiles are links; clang-format searches its style beside the target of a link.
clang-format --style="file:.clang-format" --dry-run --Werror "$@"
