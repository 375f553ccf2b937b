# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks the stubs against the module."""

import ast
import importlib
import pathlib
import unittest

import poise
from poise import _poise

FOLDER = pathlib.Path(poise.__file__).parent

def names_of(node):
    """Returns the names that a module or a class of a stub defines."""
    names = set()
    for item in node.body:
        if isinstance(item, (ast.ClassDef, ast.FunctionDef)):
            names.add(item.name)
        elif isinstance(item, ast.AnnAssign):
            names.add(item.target.id)
    return names


def public(names):
    """Leaves out what is inherited or private to pybind11."""
    return {name for name in names if not name.startswith("_") or name in (
        "__getitem__", "__setitem__", "__len__", "__contains__", "__iter__")}


class StubsTest(unittest.TestCase):
    maxDiff = None

    def test_stubs_name_what_the_module_has(self):
        stub = ast.parse((FOLDER / "_poise.pyi").read_text())
        self.assertEqual(public(names_of(stub)), public(vars(_poise)))
        classes = [item for item in stub.body if isinstance(item, ast.ClassDef)]
        self.assertGreater(len(classes), 20)
        for item in classes:
            if item.name != "InputError":
                self.assertEqual(
                    public(names_of(item)),
                    public(vars(getattr(_poise, item.name))), item.name)

    def test_stubs_of_the_groups_are_complete(self):
        for name in ("so3", "se3"):
            stub = ast.parse((FOLDER / f"{name}.pyi").read_text())
            module = importlib.import_module(f"poise.{name}")
            self.assertEqual(public(names_of(stub)),
                             public(vars(module)) - {"_poise"})
            self.assertEqual(public(names_of(stub)),
                             public(vars(getattr(_poise, name))))

    def test_everything_public_has_a_docstring(self):
        missing = []
        for name in poise.__all__:
            thing = getattr(poise, name)
            if not thing.__doc__:
                missing.append(name)
            if isinstance(thing, type):
                missing += [f"{name}.{member}" for member in public(vars(thing))
                            if not member.startswith("_")
                            and not getattr(thing, member).__doc__]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
