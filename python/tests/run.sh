#!/bin/bash
# Usage: run.sh TEST.py
# Runs a test of the package poise with the Python that Poise is built for.
set -eu
export PYTHONPATH=python MPLBACKEND=agg MPLCONFIGDIR=${TEST_TMPDIR:-/tmp}
exec python3 "$@"
