#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks that every command line of README, CONTRIBUTING and docs parses.

A program gets the options of the page with POISE_PARSE_ONLY set: it parses them
and ends with exit code 0.  Labels, configurations and scripts must exist."""

import os
import pathlib
import re
import shlex
import subprocess
import unittest

import pages

ROOT = pages.tree()
# Programs that are built for this test, by label.
PROGRAMS = {
    label: pathlib.Path(label[2:].replace(":", "/"))
    for label in (
        "//tests/exact:judge", "//tests:hqp_night", "//tests/peers:compare",
        "//tools:doctor", "//tools:dynamics", "//tools:explain",
        "//tools:figures", "//tools:hqp", "//tools:install",
        "//tools:mutate", "//tools:push", "//tools:push_map",
        "//tools:report", "//tools:robustness", "//tools:sim_to_sim",
        "//tools:strictness", "//tools/package:abi")
}


def commands(text):
    """Yields (number, command) of command lines in blocks and in quotes."""
    for number, command in pages.block_commands(text):
        if re.match(pages.COMMAND, command):
            yield number, command
    for number, line in pages.lines_outside_code(text):
        for code in re.findall(r"`([^`]+)`", line):
            # A path alone names a file; it is no command line.
            if re.match(pages.COMMAND, code) and (
                    code.startswith("bazel ") or " " in code):
                yield number, code


def label_exists(label):
    """Whether a BUILD file of the tree has the target, or the package exists."""
    if label.startswith("@") or "'" in label:
        return True
    package, _, name = label[2:].partition(":")
    if package.endswith("..."):
        return (ROOT / package[:-3]).is_dir()
    build = ROOT / package / "BUILD"
    if not build.is_file():
        return False
    name = name or pathlib.Path(package).name
    if name == "format_test":
        return "lint_test()" in build.read_text()
    return f'"{name}"' in build.read_text()


def problem(words):
    """Returns why a command does not parse, or None."""
    while words and re.match(r"[A-Z_]+=", words[0]):
        words = words[1:]
    if words[0].startswith("bazel-bin/"):
        return parse("//" + words[0][10:].replace("tools/", "tools:"), words[1:])
    if words[0] != "bazel":
        if words[0].startswith(("tools/", ".ci/")):
            exists = os.access(ROOT / words[0], os.X_OK)
            return None if exists else f"no program {words[0]}"
        return None
    if words[1] not in ("run", "test", "build", "query"):
        return f"bazel has no command {words[1]}"
    split = words.index("--") if "--" in words else len(words)
    labels = [word for word in words[2:split] if word.startswith("//")]
    for word in words[2:split]:
        config = re.match(r"--config=(\w+)", word)
        if config and not re.search(
                rf"^\w+:{config[1]} ", (ROOT / ".bazelrc").read_text(), re.M):
            return f"no configuration {config[1]} in .bazelrc"
    for label in labels:
        if not label_exists(label):
            return f"no target {label}"
    if words[1] == "run" and words[split + 1:]:
        return parse(labels[0], words[split + 1:])
    return None


def parse(label, arguments):
    """Lets the program of a label parse arguments; returns its complaint."""
    if label not in PROGRAMS:
        return f"{label} gets options, but this test does not build it"
    result = subprocess.run(
        [PROGRAMS[label].resolve(), *arguments], text=True,
        stdin=subprocess.DEVNULL, capture_output=True,
        env={**os.environ, "POISE_PARSE_ONLY": "1"}, check=False)
    return None if result.returncode == 0 else result.stderr.strip()


def problems(text):
    """Returns (number, command, reason) of the commands that do not parse."""
    found = []
    for number, line in commands(text):
        for command in re.split(r" && |; ", line):
            words = shlex.split(command.replace("[TARGET...]", ""))
            reason = problem(words) if words else None
            if reason:
                found.append((number, command, reason))
    return found


class CommandsTest(unittest.TestCase):
    def test_every_command_line_parses(self):
        folders = ("docs",)
        paths = [path for path in pages.pages(ROOT)
                 if path.parent == ROOT or
                 path.relative_to(ROOT).parts[0] in folders]
        self.assertGreater(
            sum(len(list(commands(path.read_text()))) for path in paths), 50)
        messages = [f"{path}:{number}: {command}: {reason}" for path in paths
                    for number, command, reason in problems(path.read_text())]
        self.assertEqual(messages, [])

    def test_notices_an_unknown_option(self):
        text = "`bazel run //tools:push -- --forse 3`"
        self.assertIn("--forse", problems(text)[0][2])

    def test_notices_an_unknown_target_script_and_configuration(self):
        self.assertEqual(
            [reason for _, _, reason in problems(
                "    bazel test //math:none\n    tools/none.sh 3\n"
                "    bazel build --config=none //tools:push\n")],
            ["no target //math:none", "no program tools/none.sh",
             "no configuration none in .bazelrc"])

    def test_accepts_what_the_program_accepts(self):
        self.assertEqual(
            problems("```bash\nbazel run //tools:push -- --force 3  # N\n```"),
            [])


if __name__ == "__main__":
    unittest.main()
