# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Finds private terms and bad beginnings in comments, pages and test names."""

import re

# Beginnings of a comment that leave the subject open.
BEGINNING = re.compile(r"(Of|What|Who|The same|Those)\b")

# Private terms, each with the standard term.  Only phrases that have no other
# meaning in this project are here; CONTRIBUTING.md has the rules.
TERMS = {
    r"\bis let go\b|\bare let go\b|\blet go of\b": "is removed; is released",
    r"\b(gives|give|gave|giving) way\b": "is violated; has slack",
    r"\bgave up\b": "has slack; ended without a solution",
    r"\bin the way\b": "blocking constraint",
    r"\bapex(es)?\b": "degenerate vertex",
    r"\b(is|are) no number\b|\bnumbers? that (is|are) none\b": "NaN; not finite",
    r"\bis none of\b|\bthat is none\b|\bof none\b": "is not a",
    r"\bled? astray\b": "mislead",
    r"\bas little as (can|may) be\b": "as little as possible",
    r"\bin company of\b": "together with",
    r"\bnought\b": "zero",
    r"\b(row|rows|task|tasks|level|levels) (wish|ask|lack)(es|s)?\b":
        "target; residual",
    r"\bmended\b": "fixed",
    r"\bwho(m|ever)? (is|are|was) told\b|\bthe robot is told\b":
        "the caller; the controller receives",
    r"\bwhat was not expected\b|\bthe surprise\b": "unmodelled acceleration",
    r"\bat work\b": "active",
    r"\bprice of\b": "multiplier of",
    r"\blight rows?\b|\bheavy rows?\b": "small-norm, large-norm row",
}

# Names of tests that say what something is none of.
TEST_NAME = re.compile(
    r"(ThatIsNone|IsNone|AreNone|NoNumber|Nobody|LetGo|GaveUp|GivesWay|Apex|"
    r"Wish|Lacks|InTheWay|Mended)")

COMMENT = {
    ".h": r"//[/!]?<?", ".cc": r"//[/!]?<?", ".js": "//", ".mjs": "//",
    ".ts": "//", ".tsx": "//", ".py": "#", ".sh": "#", ".bzl": "#", "": "#",
    ".yaml": "#",
}


def comment_lines(suffix, text):
    """Yields (number, comment, is_first) of the comment lines of a file."""
    mark = COMMENT[suffix]
    previous = False
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(rf"\s*{mark}( |$)(.*)", line)
        trailing = None if match else re.search(rf"[;,{{}})] +{mark} (.*)", line)
        if match:
            yield number, match[2], not previous
        elif trailing:
            yield number, trailing[1], True
        previous = bool(match) and bool(match[2])


def term_in(text):
    """Returns (phrase, standard term) of the first private term, or None."""
    for pattern, standard in TERMS.items():
        found = re.search(pattern, text, re.I)
        if found:
            return found[0], standard
    return None


def findings(name, text):
    """Returns (line, complaint) for a file of the given name."""
    suffix = name[name.rfind("."):] if "." in name.split("/")[-1] else ""
    found = []
    if suffix == ".md":
        lines = [(number, line, False)
                 for number, line in enumerate(text.split("\n"), 1)]
    else:
        lines = comment_lines(suffix, text)
    for number, line, is_first in lines:
        beginning = BEGINNING.match(line) if is_first else None
        if beginning:
            found.append((number, f"begins with {beginning[0]!r}"))
        term = term_in(line)
        if term:
            found.append((number, f"{term[0]!r}: write {term[1]!r}"))
    for match in re.finditer(
            r"^(?:TEST|TEST_F|TEST_P|RC_GTEST\w*)\(\s*\w+,\s*(\w+)", text, re.M):
        if TEST_NAME.search(match[1]):
            number = text.count("\n", 0, match.start()) + 1
            found.append((number, f"name of a test: {match[1]}"))
    return found
