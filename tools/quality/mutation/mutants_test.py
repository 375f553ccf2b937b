#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

import re
import unittest

import mutants
from cpp_source import Source

_CODE = """// Copyright: a + b, and -1.
#include "math/a+b.h"

namespace poise {
namespace {

constexpr double kSmall = 1e-8;

// A comment - with a minus.
double Half(double x) {
  return 0.5 * x;
}

}  // namespace

Thing::Thing(int n) : n_(n + 1), names_{"a - b"} {}

int Thing::Count(const std::vector<int>& v, int i) const {
  assert(i < n_ && "i - n");
  static_assert(sizeof(int) > 3);
  if (i <= 0) throw std::invalid_argument("i is " + std::to_string(i - 1));
  const Eigen::Matrix<double, 6, 6>* M = Get<3>(v);
  total_ += v[i] - Cross(i, n_);
  for (int k = 0; k < i; ++k) Add(k);
  return v[2] - M->rows();
}

}  // namespace poise
"""


class MutantsTest(unittest.TestCase):
    def setUp(self):
        self.mutants = mutants.make_mutants("a.cc", _CODE)

    def after(self, text):
        return [m.after for m in self.mutants if m.before == text]

    def test_finds_functions_and_scopes(self):
        functions = [(f.name, f.is_local) for f in Source(_CODE).functions]
        self.assertEqual(
            functions,
            [("Half", True), ("Thing::Thing", False), ("Thing::Count", False)],
        )

    def test_finds_functions_after_a_macro_with_arguments(self):
        source = Source(
            'CLONES("avx2")\nvoid Sweep(int n) noexcept { Use(n); }\n'
            'CLONES("avx2")\ndouble Sum(double a) { return a; }\n'
            "Tree::Tree(int n) noexcept : n_(n) {}\n"
        )
        self.assertEqual(
            [f.name for f in source.functions], ["Sweep", "Sum", "Tree::Tree"]
        )

    def test_finds_what_a_header_declares(self):
        header = Source(
            "class Tree final : public Base {\n public:\n  explicit Tree(int n);\n"
            "  Tree(const Tree&) = delete;\n"
            "  int nv() const { return nv_; }\n"
            "  Pose operator*(const Pose& b) const;\n"
            " private:\n  void Hide(int a = 1);\n  int nv_ = 6;\n};\n"
            "double Rounding(double scale, int n, double condition = 1);\n"
            "inline constexpr double kPi = 3.14;\n"
            "enum class Status { kOk, kBad };\n"
        )
        self.assertEqual(
            [(f.qualified, f.is_public) for f in header.functions],
            [
                ("Tree::Tree", True), ("Tree::nv", True), ("Tree::operator*", True),
                ("Tree::Hide", False), ("Rounding", True),
            ],
        )

    def test_leaves_comments_strings_includes_and_checks_alone(self):
        for mutant in self.mutants:
            for word in ("//", "#include", "assert(", "throw", "namespace"):
                if mutant.before.startswith(word):
                    self.fail(mutant.describe())
            self.assertEqual(
                mutant.before.count('"a - b"'), mutant.after.count('"a - b"')
            )

    def test_leaves_templates_and_types_alone(self):
        self.assertEqual(
            self.after("const Eigen::Matrix<double, 6, 6>* M = Get<3>(v);"), []
        )

    def test_flips_a_sum_and_takes_out_a_term_and_the_statement(self):
        self.assertEqual(
            self.after("total_ += v[i] - Cross(i, n_);"),
            [
                ";",
                "total_ -= v[i] - Cross(i, n_);",
                "total_ += v[i + 1] - Cross(i, n_);",
                "total_ += v[i] + Cross(i, n_);",
                "total_ += v[i] ;",
                "total_ += v[i] - Cross(n_, i);",
            ],
        )

    def test_mutates_initialisers_constants_loops_and_returns(self):
        self.assertIn(
            'Thing::Thing(int n) : n_(n - 1), names_{"a - b"} {}',
            [m.after for m in self.mutants],
        )
        self.assertEqual(
            self.after("constexpr double kSmall = 1e-8;"),
            [
                "constexpr double kSmall = 1e-7;",
                "constexpr double kSmall = 1e-9;",
            ],
        )
        self.assertIn(
            "for (int k = 0; k <= i; ++k) Add(k);",
            self.after("for (int k = 0; k < i; ++k) Add(k);"),
        )
        self.assertEqual(
            self.after("return 0.5 * x;"),
            ["return 1.0 * x;", "return -(0.5 * x);", "return 0.5 / x;"],
        )
        self.assertIn("return v[3] - M->rows();", self.after("return v[2] - M->rows();"))
        self.assertIn("return v[2] - M->cols();", self.after("return v[2] - M->rows();"))

    def test_applies_one_slip_and_moves_no_line(self):
        for mutant in self.mutants:
            changed = mutants.apply(mutant, _CODE)
            self.assertEqual(changed.count("\n"), _CODE.count("\n"))
            different = [
                i for i, (a, b) in enumerate(
                    zip(_CODE.split("\n"), changed.split("\n")), start=1
                ) if a != b
            ]
            self.assertIn(mutant.line, different)
            self.assertLessEqual(len(different), 3)  # Line 1 quiets warnings.

    def test_an_id_outlives_changes_elsewhere(self):
        moved = _CODE.replace("// A comment", "// Longer.\n// A comment").replace(
            "0.5", "0.25"
        )
        ids = {m.id for m in self.mutants if m.function == "Thing::Count"}
        self.assertGreater(len(ids), 10)
        self.assertLessEqual(ids, {m.id for m in mutants.make_mutants("a.cc", moved)})
        self.assertEqual(len({m.id for m in self.mutants}), len(self.mutants))


_SEARCH = """// Copyright.
double Search(const Row& row, int n) {
  double sum = 0, most = 1;
  for (int i = 0; i < n; ++i) {
    const double part = row.size * i;  // Weighted.
    if (part > most) most = part;
    sum += part - most;
  }
  const int last = n - 1;
  for (int k = 0; k < n; ++k) sum += row.Part(last, k);
  if (sum > most) sum = most;
  if (n > 2) ++calls_;
  if (n > 2) sum = 2;
  return sum;
}

struct Range {
  double low = 0;
};
"""


class DigestTest(unittest.TestCase):
    """The digest that names a mutant in the ledger."""

    def keys(self, text, path="a.cc"):
        return [m.key for m in mutants.make_mutants(path, text)]

    def changed(self, old, new, text=_SEARCH):
        """Returns the mutants of `text` that lose their key if `old` becomes `new`."""
        self.assertIn(old, text)
        keys = self.keys(text.replace(old, new))
        return [m for m in mutants.make_mutants("a.cc", text) if m.key not in keys]

    def test_is_unique(self):
        keys = self.keys(_SEARCH)
        self.assertGreater(len(keys), 30)
        self.assertEqual(len(set(keys)), len(keys))

    def test_outlives_a_renamed_parameter_and_variable(self):
        text = _SEARCH
        for old, new in (
            ("row", "line"), ("n", "count"), ("sum", "total"), ("most", "limit"),
            ("part", "share"), ("k", "i"),
        ):
            text = re.sub(rf"\b{old}\b", new, text)
            self.assertEqual(self.keys(text), self.keys(_SEARCH), f"{old} {new}")

    def test_outlives_comments_layout_and_another_file(self):
        text = _SEARCH.replace("  // Weighted.", "").replace(
            "    if (part", "    // The largest.\n    if (part"
        ).replace(" row.size * i", "\n        row.size * i")
        self.assertEqual(self.keys(text, "inner/b.cc"), self.keys(_SEARCH))

    def test_outlives_a_new_variable_and_other_functions(self):
        self.assertEqual(
            self.changed("  double sum", "  const int half = n / 2;\n  double sum"), []
        )
        self.assertEqual(self.changed("double Search", "int A() { return 1; }\n"
                                      "double Search"), [])

    def test_changes_with_its_expression_alone(self):
        for old, new in (
            ("part - most", "most - part"), ("part - most", "part + most"),
            ("part - most", "part - 2 * most"),
        ):
            changed = self.changed(old, new)
            self.assertGreater(len(changed), 2, new)
            self.assertEqual({m.before for m in changed}, {"sum += part - most;"})

    def test_changes_with_members_and_called_functions(self):
        self.assertTrue(self.changed("row.size", "row.weight"))
        self.assertTrue(self.changed("row.Part", "row.Share"))
        self.assertTrue(self.changed("calls_", "counts_"))

    def test_changes_with_the_names_of_function_and_class(self):
        changed = self.changed("Search", "Find")
        self.assertEqual({m.place for m in changed}, {"Search"})
        changed = self.changed("Range", "Interval")
        self.assertEqual({m.before for m in changed}, {"double low = 0;"})

    def test_tells_equal_expressions_of_a_function_apart(self):
        conditions = [
            m for m in mutants.make_mutants("a.cc", _SEARCH)
            if m.before.startswith("if (n > 2)") and ">=" in m.after
        ]
        first, second = (m.digest for m in conditions)
        self.assertEqual(second, first + ".2")


if __name__ == "__main__":
    unittest.main()
