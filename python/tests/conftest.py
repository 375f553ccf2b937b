# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Lets pytest run these tests with an installed package, without Bazel."""

# Bazel gives these tests files as arguments.
collect_ignore = ["mypy_test.py", "pages_test.py", "same_log_test.py",
                  "wheel_test.py"]
