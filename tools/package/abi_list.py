# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Lists the binary interface of an installed Poise.

The list has the functions and objects that the shared libraries export, and the
layout of each public class: its size, its members with offset and type, its
virtual functions. A program that was compiled with one installation works with
another one if both agree in what the program uses. One exception: the name of an
exported function does not contain the type that it returns, so a change of that
type is not noticed.

The layouts come from libabigail's abidw, which reads the debug information of a
small library. That library is compiled here from the public headers alone, so
the libraries of Poise need no debug information.
"""

import collections
import os
import pathlib
import re
import subprocess
import xml.etree.ElementTree

# Long names of usual types, and how they are written in the sources.
_SHORT = (
    ("std::__cxx11::basic_string<char, std::char_traits<char>, "
     "std::allocator<char> >", "std::string"),
    ("std::__cxx11::string", "std::string"),
    ("std::basic_string_view<char, std::char_traits<char> >",
     "std::string_view"),
    ("[abi:cxx11]", ""),
    ("Eigen::Matrix<double, 3, 1, 0, 3, 1>", "Eigen::Vector3d"),
    ("Eigen::Matrix<double, 3, 3, 0, 3, 3>", "Eigen::Matrix3d"),
    ("Eigen::Matrix<double, -1, 1, 0, -1, 1>", "Eigen::VectorXd"),
    ("Eigen::Matrix<double, -1, -1, 0, -1, -1>", "Eigen::MatrixXd"),
    ("const, 0, Eigen::InnerStride<1> >", "const>"),
    ("const, 0, Eigen::OuterStride<-1> >", "const>"),
    (", 0, Eigen::InnerStride<1> >", ">"),
    (", 0, Eigen::OuterStride<-1> >", ">"),
)


class AbiError(Exception):
    """An interface that cannot be listed, as one line."""


def _run(*command, **options):
    try:
        result = subprocess.run(
            [str(word) for word in command], text=True, check=False,
            capture_output=True, **options)
    except FileNotFoundError as error:
        raise AbiError(f"there is no {command[0]} on PATH; run tools/setup.sh "
                       "--package") from error
    if result.returncode:
        lines = result.stderr.strip().splitlines() or ["no message"]
        wrong = [line for line in lines if "error" in line] or lines
        raise AbiError(f"{command[0]} failed with exit code "
                       f"{result.returncode}: {wrong[0]}")
    return result.stdout


def short(name):
    """Returns a type's name as the sources have it."""
    for long, brief in _SHORT:
        name = name.replace(long, brief)
    # From the innermost vector to the outermost one.
    for _ in range(3):
        name = re.sub(r"std::vector<((?:(?!std::vector<).)*?), "
                      r"std::allocator<\1 ?> ?>", r"std::list_of<\1>", name)
    return name.replace("std::list_of<", "std::vector<")


def functions(prefix):
    """Returns {library: sorted names of its functions and objects}."""
    found = {}
    for library in sorted(prefix.glob("lib/libpoise_*.so.*")):
        printed = _run("nm", "-D", "-C", "--defined-only", library)
        found[library.name] = sorted(
            {short(line.split(maxsplit=2)[2]) for line in printed.splitlines()})
    if not found:
        raise AbiError(f"{prefix}/lib has no libpoise_*.so, so Poise is not "
                       "installed there; choose another prefix")
    return found


def classes(text):
    """Returns the classes, enumerations and aliases of a header, qualified.

    Templates are left out: programs compile them themselves. An alias may name
    a class that is made from a template.
    """
    found, spaces = [], []
    for match in re.finditer(
            r"^(?:namespace (?P<space>[\w:]+) \{|(?P<end>\})  // namespace"
            r"|(?P<template>template\b[^\n]*\n)?"
            r"(?:(?:enum class|class|struct) (?P<name>\w+)\b[^;({]*\{"
            r"|using (?P<alias>\w+) =))", text, re.M):
        if match["space"]:
            spaces.append(match["space"])
        elif match["end"]:
            spaces.pop()
        elif not match["template"]:
            name = match["name"] or match["alias"]
            found.append("::".join([*spaces, name]))
    return found


def layout_source(headers):
    """Returns a file with one function for each public class.

    libabigail describes the types that exported functions reach.
    """
    lines = [f'#include "{header}"' for header in headers]
    names = sorted({name for text in headers.values()
                    for name in classes(text)})
    lines += [f"void f{number}(const {name}*) {{}}"
              for number, name in enumerate(names)]
    return "\n".join([*lines, ""])


def describe(prefix, folder):
    """Returns libabigail's description of the public classes, as XML."""
    include = prefix / "include"
    headers = {str(path.relative_to(include)): path.read_text(encoding="utf-8")
               for path in sorted(include.glob("poise/**/*.h"))}
    source = folder / "layout.cc"
    source.write_text(layout_source(headers), encoding="utf-8")
    modules = [path.stem for path in prefix.glob("lib/pkgconfig/poise_*.pc")]
    flags = _run("pkg-config", "--cflags", *modules, env={
        **os.environ, "PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")})
    library = folder / "layout.so"
    # The last option describes also classes whose functions are elsewhere.
    _run("g++", "-std=c++17", "-g", "-O0", "-w", "-fPIC", "-shared",
         *flags.split(), source, "-o", library, "-femit-class-debug-always")
    return _run("abidw", "--no-corpus-path", "--no-comp-dir-path",
                "--no-show-locs", library)


class _Types:
    """The types of an XML file of libabigail."""

    def __init__(self, root):
        self.elements = {}  # By identifier.
        self.names = {}  # Qualified names, by identifier.
        self._visit(root, "")

    def _visit(self, element, scope):
        for child in element:
            inner = scope
            if child.tag in ("namespace-decl", "class-decl"):
                inner = f"{scope}{child.get('name')}::"
            identifier = child.get("id")
            if identifier and identifier not in self.elements:
                self.elements[identifier] = child
                self.names[identifier] = scope + child.get("name", "")
            self._visit(child, inner)

    def name(self, identifier):
        """Returns a type's name as C++ has it, nearly."""
        element = self.elements[identifier]
        inner = element.get("type-id")
        if element.tag == "qualified-type-def":
            return "const " + self.name(inner)
        if element.tag == "pointer-type-def":
            return self.name(inner) + "*"
        if element.tag == "reference-type-def":
            return self.name(inner) + "&"
        if element.tag == "array-type-def":
            return self.name(inner) + "".join(
                f"[{each.get('length')}]" for each in element)
        return short(self.names[identifier] or element.tag)


def _layout(types, element):
    """Returns {what: its description} of a class or enumeration."""
    if element.tag == "enum-decl":
        return {f"value {each.get('name')}": each.get("value")
                for each in element.iter("enumerator")}
    found = {"size": f"{int(element.get('size-in-bits')) // 8} bytes"}

    def add(what, bits, identifier):
        found[what] = f"{types.name(identifier)} at byte {int(bits) // 8}"

    for each in element.findall("base-class"):
        add(f"base class {types.name(each.get('type-id'))}",
            each.get("layout-offset-in-bits"), each.get("type-id"))
    for each in element.findall("data-member"):
        if each.get("static") != "yes":
            variable = each.find("var-decl")
            add(f"member {variable.get('name')}",
                each.get("layout-offset-in-bits"), variable.get("type-id"))
    for each in element.findall("member-function"):
        if each.get("vtable-offset") is not None:
            # Overloads and the two destructors have one name.
            offset = each.get("vtable-offset")
            found[f"virtual function {offset}"] = each.find(
                "function-decl").get("name")
    return found


def layouts(description):
    """Returns {class: {what: its description}} of libabigail's XML."""
    types = _Types(xml.etree.ElementTree.fromstring(description))
    found = {}
    for identifier, element in types.elements.items():
        name = types.names[identifier]
        if name.startswith("poise::") and element.tag in (
                "class-decl", "enum-decl") and (
                    element.get("is-declaration-only") != "yes"):
            found[name] = _layout(types, element)
    return dict(sorted(found.items()))


def interface(prefix, folder):
    """Returns the interface of an installation; folder is for files."""
    prefix = pathlib.Path(prefix)
    return collections.OrderedDict(
        functions=functions(prefix),
        classes=layouts(describe(prefix, pathlib.Path(folder))))
