# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks the stubs against the module."""

import ast
import importlib
import inspect
import pathlib
import pydoc
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


def members_of(kind):
    """Returns the names of a class; without a constructor, pybind11 adds one that
    raises."""
    has_constructor = type(kind.__init__).__name__ == "instancemethod"
    return set(vars(kind)) - (set() if has_constructor else {"__init__"})


def public(names):
    """Leaves out what is inherited or private to pybind11."""
    return {name for name in names if not name.startswith("_") or name in (
        "__init__", "__getitem__", "__setitem__", "__len__", "__contains__", "__iter__")}


def parameters_of_stub(function):
    """Returns (name, default or None) of each parameter, and "*" before those
    that must be given by keyword."""
    given = function.args
    names = [each.arg for each in given.args]
    defaults = [None] * (len(names) - len(given.defaults)) + given.defaults
    made = [(name, default and ast.unparse(default))
            for name, default in zip(names, defaults)]
    if given.kwonlyargs:
        made.append("*")
    return made + [(each.arg, default and ast.unparse(default))
                   for each, default in zip(given.kwonlyargs,
                                            given.kw_defaults)]


def parameters_of_function(function):
    """Returns the parameters of a function of the module in the same form."""
    made = []
    for name, each in inspect.signature(function).parameters.items():
        if each.kind == each.KEYWORD_ONLY and "*" not in made:
            made.append("*")
        is_required = each.default is inspect.Parameter.empty
        made.append((name, None if is_required else repr(each.default)))
    return made


def functions_of_stub():
    """Yields (module or class, definition) of each function and method."""
    for name in ("so3", "se3"):
        for item in ast.parse((FOLDER / f"{name}.pyi").read_text()).body:
            if isinstance(item, ast.FunctionDef):
                yield getattr(_poise, name), item
    for item in ast.parse((FOLDER / "_poise.pyi").read_text()).body:
        if isinstance(item, ast.FunctionDef):
            yield _poise, item
        elif isinstance(item, ast.ClassDef):
            for member in item.body:
                if isinstance(member, ast.FunctionDef) and not any(
                        ast.unparse(each).endswith(("property", ".setter"))
                        for each in member.decorator_list):
                    yield getattr(_poise, item.name), member


class StubsTest(unittest.TestCase):
    maxDiff = None

    def test_stubs_have_the_parameters_of_the_functions(self):
        functions = 0
        for owner, stub in functions_of_stub():
            with self.subTest(name=f"{owner.__name__}.{stub.name}"):
                wanted = parameters_of_stub(stub)
                functions += 1
                self.assertEqual(
                    parameters_of_function(getattr(owner, stub.name)), wanted)
        self.assertGreater(functions, 50)

    def test_help_shows_no_type_of_cpp(self):
        self.assertEqual(str(inspect.signature(poise.Tree.rnea)),
                         "(self, q, v, vdot, forces=None)")
        text = "".join(pydoc.render_doc(module, renderer=pydoc.plaintext)
                       for module in (_poise, _poise.so3, _poise.se3))
        self.assertIn(" rnea(self, q, v, vdot, forces=None)", text)
        for word in ("handle", "std::", "poise::", "arg0"):
            self.assertNotIn(word, text)

    def test_stubs_name_what_the_module_has(self):
        stub = ast.parse((FOLDER / "_poise.pyi").read_text())
        self.assertEqual(public(names_of(stub)), public(vars(_poise)))
        classes = [item for item in stub.body if isinstance(item, ast.ClassDef)]
        self.assertGreater(len(classes), 20)
        for item in classes:
            if item.name != "InputError":
                self.assertEqual(
                    public(names_of(item)),
                    public(members_of(getattr(_poise, item.name))), item.name)

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
