#!/bin/bash
# Usage: layer_test.sh CLOSURE ALLOWED FORBIDDEN HEADERS SOURCE...
# CLOSURE    a file of labels, one a line
# ALLOWED    a regex that every label must match
# FORBIDDEN  a regex that no label may match
# HEADERS    a regex of system headers that no SOURCE may include
set -eu
closure=$1 allowed=$2 forbidden=$3 headers=$4
shift 4
status=0
test -s "$closure"
if strays=$(grep -Ev "$allowed" "$closure"); then
  printf 'Out of reach for this layer:\n%s\n' "$strays"
  status=1
fi
if strays=$(grep -E "$forbidden" "$closure"); then
  printf 'Not for this layer:\n%s\n' "$strays"
  status=1
fi
if strays=$(grep -nHE "^ *# *include +$headers" "$@"); then
  printf 'Not a header of this layer:\n%s\n' "$strays"
  status=1
fi
exit $status
