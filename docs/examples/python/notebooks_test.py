# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks that each notebook is the one of its script, without output.

Usage: notebooks_test.py SCRIPT...
"""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, "docs/examples/python")
import make_notebooks  # pylint: disable=wrong-import-position

FOLDER = pathlib.Path("docs/examples/python")
SCRIPTS = [FOLDER / name for name in sys.argv[1:]]


class NotebooksTest(unittest.TestCase):
    maxDiff = None

    def test_notebooks_are_those_of_the_scripts(self):
        self.assertGreater(len(SCRIPTS), 5)
        for script in SCRIPTS:
            notebook = FOLDER / "notebooks" / (script.stem + ".ipynb")
            self.assertEqual(
                notebook.read_text(encoding="utf-8"),
                make_notebooks.notebook(script.read_text(encoding="utf-8")),
                f"run docs/examples/python/make_notebooks.py for {notebook}")

    def test_the_push_has_at_most_15_lines(self):
        text = (FOLDER / "push.py").read_text(encoding="utf-8")
        lines = [line for line in text.splitlines()
                 if line and not line.startswith(("#", '"""'))]
        self.assertLessEqual(len(lines), 15)


class NotebookTest(unittest.TestCase):
    def test_makes_cells_without_output(self):
        text = make_notebooks.notebook(
            '# A licence.\n"""A title.\n\nMore."""\n\n'
            "# %%\na = 1\n\nb = 2\n\n"
            "# %% [markdown]\n# Text of\n#\n# two paragraphs.\n\n"
            "# %%\nprint(a)\n")
        cells = json.loads(text)["cells"]
        self.assertEqual(
            [(cell["cell_type"], "".join(cell["source"])) for cell in cells],
            [("markdown", "# A title.\n\nMore."), ("code", "a = 1\n\nb = 2"),
             ("markdown", "Text of\n\ntwo paragraphs."),
             ("code", "print(a)")])
        self.assertEqual([cell["outputs"] for cell in cells
                          if cell["cell_type"] == "code"], [[], []])

    def test_rejects_scripts_that_are_no_notebooks(self):
        for text, message in (("# %%\na = 1\n", "needs a docstring"),
                              ('"""A."""\nimport os\n# %%\n', "'# %%'"),
                              ('"""A."""\n# %% [raw]\n', "markdown")):
            with self.assertRaisesRegex(ValueError, message):
                make_notebooks.notebook(text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
