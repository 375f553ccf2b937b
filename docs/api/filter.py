#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Prints a header for Doxygen: formulas and tables of docstrings as Markdown.

In a docstring, a formula is indented by four spaces or more, and a table has no
line below its head. Markdown needs an empty line before both, and the line. The text
after the last @param is about the function, and needs an empty line too."""

import re
import sys


def converted(lines):
    """Yields the lines of a header, with the lines that Markdown needs."""
    kind = "code"  # Kind of the line before.
    in_command = False  # Whether an @param is open.
    for line in lines:
        comment = re.match(r"(\s*///)( *)(.*)", line)
        if not comment:
            kind, in_command = "code", False
            yield line
            continue
        mark, indent, text = comment.groups()
        before, kind = kind, "text"
        if not text:
            kind, in_command = "empty", False
        elif text.startswith("@"):
            in_command = text.startswith("@param")
        elif len(indent) == 1 and in_command:
            in_command = False
            yield mark
        if text.startswith("|") and text.endswith("|") and not in_command:
            kind = "table"
        elif len(indent) > 4 and not in_command:
            kind = "formula"
        if kind in ("table", "formula") and before == "text":
            yield mark
        yield line
        if kind == "table" and before != "table":
            yield f"{mark} |" + " --- |" * (text.count("|") - 1)


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as header:
        print("\n".join(converted(header.read().split("\n"))))
