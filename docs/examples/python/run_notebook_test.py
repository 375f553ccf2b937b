# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Runs a notebook as Jupyter does, and looks at its output.

Usage: run_notebook_test.py NOTEBOOK
"""

import os
import pathlib
import sys
import tempfile
import unittest

import nbclient
import nbformat

NOTEBOOK = pathlib.Path(sys.argv[1]).resolve()

# Notebooks that show a figure, and those that show a Run.
FIGURES = ("push", "stepping")
RUNS = ("push", "stepping")


def outputs(notebook, kind):
    """Returns the outputs of a MIME type."""
    return [output["data"][kind] for cell in notebook.cells
            for output in cell.get("outputs", ())
            if kind in output.get("data", ())]


class RunNotebookTest(unittest.TestCase):
    def test_runs_to_its_end(self):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        nbformat.validate(notebook)
        with tempfile.TemporaryDirectory(
                dir=os.environ.get("TEST_TMPDIR")) as folder:
            os.environ.update(
                HOME=folder, IPYTHONDIR=folder, JUPYTER_RUNTIME_DIR=folder)
            # Jupyter's own backend draws figures into the notebook.
            os.environ.pop("MPLBACKEND", None)
            nbclient.NotebookClient(
                notebook, timeout=600, kernel_name="python3",
                resources={"metadata": {"path": folder}}).execute()
        figures, pages = outputs(notebook, "image/png"), [
            page for page in outputs(notebook, "text/html")
            if page.startswith("<iframe srcdoc=")]
        self.assertEqual(bool(figures), NOTEBOOK.stem in FIGURES)
        self.assertEqual(len(pages), int(NOTEBOOK.stem in RUNS))
        for page in pages:
            self.assertIn("&lt;!doctype html&gt;", page)
            self.assertTrue(page.endswith("</iframe>"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
