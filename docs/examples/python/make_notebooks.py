#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Makes a notebook of each example: the scripts are the only source.

Usage: make_notebooks.py

Writes notebooks/NAME.ipynb, without output, for each script NAME.py beside this
file. A script has the percent format of Jupytext and VS Code: "# %%" begins a
cell of code, and "# %% [markdown]" one of text. Its docstring is the first
cell. Run this program after a change of a script.
"""

import ast
import json
import pathlib
import re

METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python",
                   "name": "python3"},
    "language_info": {"name": "python"},
}


def text_cell(text):
    """Returns a cell of Markdown."""
    return {"cell_type": "markdown", "metadata": {},
            "source": text.strip().splitlines(keepends=True)}


def code_cell(text):
    """Returns a cell of code without output."""
    return {"cell_type": "code", "execution_count": None, "metadata": {},
            "outputs": [], "source": text.strip().splitlines(keepends=True)}


def notebook(script):
    """Returns the text of the notebook of a script, given its text."""
    title = ast.get_docstring(ast.parse(script))
    if title is None:
        raise ValueError("a script needs a docstring, its title")
    cells = [text_cell("# " + title)]
    parts = re.split(r"^# %%(.*)\n", script, flags=re.M)
    if '"""' not in parts[0] or re.search(r"^import", parts[0], re.M):
        raise ValueError("a script needs a line '# %%' after its docstring")
    for kind, body in zip(parts[1::2], parts[2::2]):
        if kind.strip() == "[markdown]":
            cells.append(text_cell(re.sub(r"^# ?", "", body, flags=re.M)))
        elif kind.strip() == "":
            cells.append(code_cell(body))
        else:
            raise ValueError(f"'# %%{kind}' must be '# %%' or "
                             "'# %% [markdown]'")
    return json.dumps({"cells": cells, "metadata": METADATA, "nbformat": 4,
                       "nbformat_minor": 4}, indent=1) + "\n"


def main():
    folder = pathlib.Path(__file__).parent
    for script in sorted(folder.glob("*.py")):
        text = script.read_text(encoding="utf-8")
        if re.search(r"^# %%$", text, re.M):
            made = folder / "notebooks" / (script.stem + ".ipynb")
            made.write_text(notebook(text), encoding="utf-8")
            print("wrote", made)


if __name__ == "__main__":
    main()
