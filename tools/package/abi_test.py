#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests the list of the binary interface, and what is said of a difference."""

import copy
import json
import pathlib
import subprocess
import sys
import unittest

import abi
import abi_compare
import abi_list

# The description by libabigail of an enumeration, and of
# struct Box : Shape { double size[3]; virtual int Area(); static int count; };
XML = """<abi-corpus><abi-instr>
 <type-decl name="double" id="1"/>
 <array-type-def dimensions="1" type-id="1" id="2"><subrange length="3"/>
 </array-type-def>
 <namespace-decl name="poise">
  <class-decl name="Shape" size-in-bits="64" id="3"/>
  <class-decl name="Hidden" is-declaration-only="yes" id="4"/>
  <class-decl name="Box" size-in-bits="256" id="5">
   <base-class layout-offset-in-bits="0" type-id="3"/>
   <data-member layout-offset-in-bits="64">
    <var-decl name="size" type-id="2"/></data-member>
   <data-member static="yes"><var-decl name="count" type-id="1"/>
   </data-member>
   <member-function vtable-offset="2"><function-decl name="Area"/>
   </member-function>
  </class-decl>
  <enum-decl name="Side" id="6"><underlying-type type-id="1"/>
   <enumerator name="kLeft" value="0"/></enum-decl>
 </namespace-decl>
</abi-instr></abi-corpus>"""
BEFORE = {
    "functions": {"libpoise_hqp.so.0": [
        "poise::Area(poise::Box const&)", "poise::Solve(int)"]},
    "classes": {"poise::Box": {"size": "32 bytes",
                               "member size": "double[3] at byte 8",
                               "virtual function 2": "Area"},
                "poise::Side": {"value kLeft": "0"}}}


class ListTest(unittest.TestCase):
    def test_lists_sizes_members_bases_functions_and_values(self):
        self.assertEqual(abi_list.layouts(XML), {
            "poise::Box": {"size": "32 bytes",
                           "base class poise::Shape": "poise::Shape at byte 0",
                           "member size": "double[3] at byte 8",
                           "virtual function 2": "Area"},
            "poise::Shape": {"size": "8 bytes"},
            "poise::Side": {"value kLeft": "0"}})

    def test_finds_the_classes_of_a_header(self):
        text = ("namespace poise {\nnamespace inner {\nstruct A {\n};\n"
                "}  // namespace inner\nclass B final\n    : public A {\n"
                "  struct Nested {\n};\nclass Announced;\n"
                "template <int n>\nclass C {\n};\nenum class D { kOne };\n"
                "using E = C<3>;\ntemplate <int n>\nusing F = C<n>;\n"
                "A Make();\n}  // namespace poise\n")
        self.assertEqual(abi_list.classes(text), [
            "poise::inner::A", "poise::B", "poise::D", "poise::E"])

    def test_writes_names_as_the_sources_do(self):
        text = "std::__cxx11::basic_string<char, std::char_traits<char>, " \
               "std::allocator<char> >"
        self.assertEqual(abi_list.short(text), "std::string")
        for _ in range(2):
            text = f"std::vector<{text}, std::allocator<{text} > >"
        self.assertEqual(abi_list.short(text),
                         "std::vector<std::vector<std::string>>")


class CompareTest(unittest.TestCase):
    def broken(self, change):
        new = copy.deepcopy(BEFORE)
        change(new["functions"], new["classes"])
        return abi_compare.broken(BEFORE, new)

    def test_equal_interfaces_and_additions_break_nothing(self):
        def add(functions, classes):
            functions["libpoise_hqp.so.0"].append("poise::More()")
            functions["libpoise_gait.so.0"] = ["poise::Step()"]
            classes["poise::New"] = {"size": "8 bytes"}
            classes["poise::Side"]["value kRight"] = "1"
        self.assertEqual(self.broken(add), [])
        new = copy.deepcopy(BEFORE)
        add(new["functions"], new["classes"])
        self.assertEqual(abi_compare.additions(BEFORE, new), 3)

    def test_each_break_is_one_sentence(self):
        hqp, box = "libpoise_hqp.so.0", "poise::Box"
        for change, sentence in (
                (lambda f, c: f[hqp].remove("poise::Solve(int)"),
                 f"{hqp} no longer exports poise::Solve(int)."),
                (lambda f, c: f.update({hqp: [
                    "poise::Area(poise::Box const&)", "poise::Solve(long)"]}),
                 f"{hqp}: poise::Solve has other arguments: was "
                 "poise::Solve(int), is poise::Solve(long)."),
                (lambda f, c: f.clear(), f"{hqp} is gone."),
                (lambda f, c: c.pop(box),
                 "poise::Box is gone, or no public class uses it."),
                (lambda f, c: c[box].update({"size": "40 bytes"}),
                 "poise::Box: size is 40 bytes; before, it was 32 bytes."),
                (lambda f, c: c[box].update({
                    "member size": "double[3] at byte 16"}),
                 "poise::Box: member size is double[3] at byte 16; before, it "
                 "was double[3] at byte 8."),
                (lambda f, c: c[box].update({
                    "member size": "float[3] at byte 8"}),
                 "poise::Box: member size is float[3] at byte 8; before, it "
                 "was double[3] at byte 8."),
                (lambda f, c: c[box].pop("member size"),
                 "poise::Box: member size is gone; it was double[3] at byte "
                 "8."),
                (lambda f, c: c[box].update({"virtual function 3": "Edge"}),
                 "poise::Box: virtual function 3 is new; it is Edge."),
                (lambda f, c: c["poise::Side"].update({"value kLeft": "1"}),
                 "poise::Side: value kLeft is 1; before, it was 0.")):
            self.assertEqual(self.broken(change), [sentence])


    def test_members_that_moved_together_are_one_sentence(self):
        old = {"functions": {}, "classes": {"A": {
            f"member {n}": f"int at byte {4 * n}" for n in range(3)}}}
        new = {"functions": {}, "classes": {"A": {
            f"member {n}": f"int at byte {4 * n + 8}" for n in range(3)}}}
        self.assertEqual(abi_compare.broken(old, new), [
            "A: member 0 is int at byte 8; before, it was int at byte 0, and 2 "
            "more moved."])


class CommandTest(unittest.TestCase):
    def test_the_recorded_list_has_each_layer_and_public_classes(self):
        path = pathlib.Path(abi.__file__).resolve().parent / "abi.json"
        recorded = json.loads(path.read_text(encoding="utf-8"))
        self.assertGreater(len(recorded["functions"]), 6)
        for name in ("poise::Tree", "poise::Solver", "poise::Plant",
                     "poise::Controller"):
            self.assertIn("size", recorded["classes"][name])

    def test_bad_input_is_one_line_and_exit_code_2(self):
        for arguments, word in ((["--against", "/nowhere"], "/nowhere"),
                                (["--against", "x", "--record"], "--record"),
                                (["--wings"], "--wings")):
            result = subprocess.run(
                [sys.executable, abi.__file__, *arguments], text=True,
                check=False, capture_output=True)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main()
