#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks links, widths, lengths and tables of the pages, and equations.md."""

import pathlib
import re
import unittest

import pages
import run_pages

ROOT = pages.tree()
HANDBOOK = sorted([*(ROOT / "docs").glob("*.md"),
                   *(ROOT / "docs/quickstart").glob("*.md")])


class DocsTest(unittest.TestCase):
    def test_each_link_leads_to_a_file_or_a_heading(self):
        messages = []
        for path in pages.pages(ROOT):
            messages += pages.broken_links(path, path.read_text())
        self.assertEqual(messages, [])

    def test_lines_have_at_most_120_columns(self):
        # Programs write the generated pages. A table of the notebook has one row
        # a run.
        messages = []
        for path in pages.pages(ROOT):
            if path.parent.name == "generated":
                continue
            for number, line in enumerate(path.read_text().split("\n"), 1):
                if len(line) > 120 and not (line.startswith("|") and
                                            path not in HANDBOOK):
                    messages.append(f"{path}:{number}: {len(line)} columns")
        self.assertEqual(messages, [])

    def test_handbook_pages_have_at_most_150_lines(self):
        messages = []
        for path in HANDBOOK:
            length = path.read_text().count("\n")
            if length > 150:
                messages.append(f"{path}: {length} lines")
        self.assertEqual(messages, [])

    def test_handbook_tables_have_at_most_6_columns_and_15_rows(self):
        messages = []
        for path in HANDBOOK:
            for number, columns, rows in pages.tables(path.read_text()):
                if columns > 6 or rows > 15:
                    messages.append(
                        f"{path}:{number}: {columns} columns, {rows} rows")
        self.assertEqual(messages, [])

    def test_the_index_names_each_page(self):
        index = (ROOT / "docs/index.md").read_text()
        targets = {target for _, target in pages.links(index)}
        for path in [*HANDBOOK, *(ROOT / "docs/generated").glob("*.md")]:
            if path.name != "index.md":
                self.assertIn(str(path.relative_to(ROOT / "docs")), targets)

    def test_the_changelog_begins_with_the_present_version(self):
        versions = re.findall(r"^## \[(.*)\]", (ROOT / "CHANGELOG.md").read_text(),
                              re.M)
        self.assertEqual(versions[0], (ROOT / "VERSION").read_text().strip())

    def test_generated_pages_name_their_command(self):
        for path in (ROOT / "docs/generated").glob("*.md"):
            first_lines = "\n".join(path.read_text().split("\n")[:12])
            self.assertIn("bazel run //", first_lines, path)


class CodeTest(unittest.TestCase):
    """Readers can copy C++ from the pages: each block is part of a built file."""

    # Programs and examples that tests build.
    BUILT = ("docs/examples/*/main.cc", "docs/examples/cmake/*.cc",
             "tests/embedding/*.cc", "tests/examples/*.cc", "tests/examples/*.h")

    def setUp(self):
        text = "".join(path.read_text() for pattern in self.BUILT
                       for path in sorted(ROOT.glob(pattern)))
        # tasks.md tells readers to put their task beside those of Poise.
        self.built = pages.unindented(
            text.replace("tests/examples/", "robot/control/tasks/"))

    def unknown(self, text):
        return [number for number, block in pages.blocks(text, "cpp")
                if pages.unindented(block) not in self.built]

    def test_each_block_of_cpp_is_part_of_a_built_file(self):
        paths = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *HANDBOOK]
        self.assertEqual([f"{path}:{number}" for path in paths
                          for number in self.unknown(path.read_text())], [])
        self.assertGreater(
            sum(len(list(pages.blocks(path.read_text(), "cpp")))
                for path in paths), 5)

    def test_each_block_of_code_in_a_docstring_is_part_of_a_built_file(self):
        blocks = []
        for layer in ("math", "dynamics", "hqp", "robot", "sim"):
            for path in sorted((ROOT / layer).rglob("*.h")):
                for block in re.findall(r"(?:^ *///     .*\n)+",
                                        path.read_text(), re.M):
                    if ");\n" in block:  # A call; else it is an equation.
                        code = re.sub(r"^ *///", "", block, flags=re.M)
                        blocks.append((str(path), pages.unindented(code)))
        self.assertEqual([path for path, code in blocks
                          if code not in self.built], [])
        self.assertGreater(len(blocks), 1)

    def test_the_quickstart_of_bazel_is_the_example_that_a_test_builds(self):
        page = (ROOT / "docs/quickstart/bazel.md").read_text()
        example = ROOT / "docs/examples/dynamics"
        blocks = [block for _, block in pages.blocks(page, "python")]
        for block, file, name in zip(blocks, ("WORKSPACE", "BUILD"), (
                "poise_dynamics_example", "simulate")):
            text = re.sub(r"^#.*\n", "", (example / file).read_text(),
                          flags=re.M)
            self.assertEqual(
                pages.unindented(block.replace("my_robot", name).replace(
                    '"../poise"', '"../../.."')), pages.unindented(text))
        self.assertEqual(len(blocks), 2)

    def test_each_command_that_does_not_run_is_on_a_page(self):
        commands = [command for _, _, command in run_pages.page_commands([])]
        self.assertGreater(len(commands), 30)
        for start in [*run_pages.NOT_RUN, *run_pages.EXIT_CODES]:
            self.assertTrue(
                any(command.startswith(start) for command in commands), start)

    def test_notices_a_block_that_is_not_built(self):
        self.assertEqual(self.unknown("a\n```cpp\nint none();\n```\n"), [2])


class EquationsTest(unittest.TestCase):
    """Each equation has code and a test, and both exist."""

    def setUp(self):
        self.text = (ROOT / "docs/equations.md").read_text()
        self.items = re.findall(
            r"^- \*\*(\S+)\*\* .*\n  - code: (.*)\n  - test: (.*)$",
            re.sub(r"\n    ", " ", self.text), re.M)

    def test_every_numbered_equation_of_the_paper_is_there_once(self):
        numbers = [number for number, _, _ in self.items]
        self.assertEqual(numbers,
                         [f"({i})" for i in range(1, 22)] + ["3.7"])

    def test_each_file_has_the_name(self):
        for number, code, _ in self.items:
            pairs = re.findall(r"`(\S+)` `(\w+)`", code)
            self.assertTrue(pairs, number)
            for file, name in pairs:
                self.assertRegex((ROOT / file).read_text(), rf"\b{name}\b")

    def test_each_test_exists(self):
        for number, _, test in self.items:
            pairs = re.findall(r"`(\S+)` `(\w+)\.(\w+)`", test)
            self.assertTrue(pairs, number)
            for file, suite, name in pairs:
                self.assertRegex((ROOT / file).read_text(),
                                 rf"\(\s*{suite},\s*{name}\b")


class PagesTest(unittest.TestCase):
    """The checks above notice what they are for."""

    def test_notices_broken_links(self):
        path = ROOT / "docs/index.md"
        text = "[a](tour.md) [b](none.md) [c](tour.md#nowhere) [d](#here)\n# Here"
        self.assertEqual(
            [message.split(": ")[1] for message in
             pages.broken_links(path, text)],
            ["no file 'none.md'", "no heading 'tour.md#nowhere'"])

    def test_makes_the_anchors_of_headings(self):
        self.assertEqual(pages.anchors("## If it's `ok`, go\n```\n# no\n```"),
                         {"if-its-ok-go"})

    def test_counts_the_columns_and_rows_of_tables(self):
        text = "a\n| x \\| y | z |\n| --- | --- |\n| 1 | 2 |\n| 3 | 4 |\n"
        self.assertEqual(list(pages.tables(text)), [(2, 2, 2)])

    def test_ignores_links_in_code_and_to_the_web(self):
        text = "[a](https://b.c)\n```\n[d](e)\n```\n[f](g.md)"
        self.assertEqual(list(pages.links(text)), [(5, "g.md")])


if __name__ == "__main__":
    unittest.main()
