#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests which symbols a library exports."""

import pathlib
import platform
import subprocess
import tempfile
import unittest

import link_layer

HEADER = """
namespace poise {
class Tree { int size() const; };
class Solver final : public Base { struct Impl; void Solve(int n); ~Solver(); };
struct Mesh;
struct Mesh { int n; };
std::ostream& operator<<(std::ostream& out, const Tree& tree);
double Sum(double a, double b);
}
"""


class DeclaredTest(unittest.TestCase):
    def test_exports_what_a_header_declares(self):
        for name in ("poise::Sum(double, double)", "poise::Solver::Solve(int)",
                     "poise::Solver::~Solver()", "poise::Tree::size() const",
                     "vtable for poise::Solver",
                     "poise::Sum[abi:cxx11](double)", "poise::Mesh::Mesh(int)",
                     "typeinfo name for poise::Solver",
                     "poise::operator<<(std::ostream&, poise::Tree const&)"):
            self.assertTrue(link_layer.is_declared(name, HEADER), name)

    def test_hides_functions_that_no_header_declares(self):
        self.assertFalse(link_layer.is_declared("poise::Helper(int)", HEADER))

    def test_hides_classes_that_a_header_only_announces(self):
        for name in ("poise::Solver::Impl::Impl(int)",
                     "poise::Solver::Impl::Solve(int)"):
            self.assertFalse(link_layer.is_declared(name, HEADER), name)

    def test_script_exports_nothing_else(self):
        self.assertEqual(link_layer.version_script(["f"]),
                         "{\nglobal:\n  f;\nlocal:\n  *;\n};\n")


class SymbolsTest(unittest.TestCase):
    @unittest.skipUnless(platform.machine() == "x86_64", "AVX2 is for x86-64")
    def test_exports_functions_of_several_versions(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "sum.cc")
            source.write_text(
                '__attribute__((target_clones("avx2", "default")))\n'
                "double Sum(double a, double b) { return a + b; }\n"
                "double Helper(double a) { return Sum(a, a); }\n")
            header = pathlib.Path(folder, "sum.h")
            header.write_text("double Sum(double a, double b);\n")
            subprocess.run(["g++", "-c", "-O1", source.name], check=True,
                           cwd=folder)
            self.assertEqual(
                link_layer.exported_symbols(
                    "nm", [str(source.with_suffix(".o"))], [str(header)]),
                ["_Z3Sumdd"])


if __name__ == "__main__":
    unittest.main()
