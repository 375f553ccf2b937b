#!/bin/bash
# Usage: run.sh TEST.py [ARGUMENT...]
# Runs a test of the package poise with the Python that Poise is built for.
set -eu
export PYTHONPATH=$PWD/python MPLBACKEND=${MPLBACKEND-agg}
export MPLCONFIGDIR=${TEST_TMPDIR:-/tmp}
exec /usr/bin/python3 "$@"
