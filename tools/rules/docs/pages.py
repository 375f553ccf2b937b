# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Reads the Markdown pages of the source tree."""

import pathlib
import re


def tree():
    """Returns the root of the source tree, to which Bazel links WORKSPACE."""
    return pathlib.Path("WORKSPACE").resolve().parent


def pages(root):
    """Returns the paths of all Markdown files of the tree, sorted."""
    hidden = ("node_modules", "bazel-")
    return sorted(
        path for path in root.rglob("*.md")
        if not any(part.startswith(hidden)
                   for part in path.relative_to(root).parts))


def lines_outside_code(text):
    """Yields (number, line) of the lines that no code fence contains."""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


def blocks(text, language):
    """Yields (number, text) of the fenced blocks of a language."""
    start, lines = None, []
    for number, line in enumerate(text.split("\n"), 1):
        if start is None:
            if line.strip() == "```" + language:
                start, lines = number, []
        elif line.strip() == "```":
            yield start, "\n".join(lines) + "\n"
            start = None
        else:
            lines.append(line)


# A line that calls Bazel or a script of the tree, perhaps with variables before it.
COMMAND = r"(?:[A-Z_]+=\S+ )*(?:bazel |tools/|\.ci/)"


def block_commands(text):
    """Yields (number, command) of the code blocks of shell commands.

    These are fenced blocks of the language bash, and blocks that are indented by
    four spaces and call Bazel or a script of the tree."""
    language = None
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            language = line.strip()[3:] if language is None else None
        elif line.strip() and (
                language == "bash" if language is not None
                else re.match(r"    " + COMMAND, line)):
            yield number, re.sub(r"\s+#.*", "", line.strip())


def unindented(text):
    """Returns the text without the spaces at the beginning of each line."""
    return re.sub(r"^ +", "", text, flags=re.M)


def anchors(text):
    """Returns the anchors of a page's headings, as GitHub makes them."""
    found = set()
    for _, line in lines_outside_code(text):
        heading = re.match(r"#+ (.*)", line)
        if heading:
            words = re.sub(r"[^\w\- ]", "", heading[1].lower())
            found.add(words.strip().replace(" ", "-"))
    return found


def links(text):
    """Yields (number, target) of the links that lead to files or anchors."""
    for number, line in lines_outside_code(text):
        for target in re.findall(r"\]\(([^)\s]+)\)", line):
            if not re.match(r"[a-z]+:", target):
                yield number, target


def broken_links(path, text):
    """Returns a message for each link of the page that leads nowhere."""
    messages = []
    for number, target in links(text):
        name, _, anchor = target.partition("#")
        file = (path.parent / name) if name else path
        if not file.exists():
            messages.append(f"{path}:{number}: no file {target!r}")
        elif anchor and anchor not in anchors(
                file.read_text() if name else text):
            messages.append(f"{path}:{number}: no heading {target!r}")
    return messages


def tables(text):
    """Yields (number of the header's line, columns, rows) of each table."""
    header, rows = None, 0
    for number, line in [*lines_outside_code(text), (0, "")]:
        if line.startswith("|"):
            if header is None:
                header, rows = (number, line), 0
            else:
                rows += 1
        elif header is not None:
            columns = len(re.findall(r"(?<!\\)\|", header[1])) - 1
            yield header[0], columns, rows - 1
            header = None
