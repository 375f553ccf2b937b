# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Hierarchy and poise.Solver by problems with known answers."""

import threading
import unittest

import numpy as np

import poise


def corner():
    """Returns a hierarchy with the answer y = (1, 3).

    Level 0 bounds y[0] <= 1; level 1 wants y[0] = 3; level 2 wants
    y[0] + y[1] = 4.
    """
    hierarchy = poise.Hierarchy(2)
    hierarchy.add_level(C=[[1, 0]], upper=[1], name="limits",
                        inequality_names=["x"])
    hierarchy.add_level(B=[[1, 0]], b=[-3], name="target",
                        equality_names=["go right"])
    hierarchy.add_level(B=[[1, 1]], b=[-4])
    return hierarchy


class SolverTest(unittest.TestCase):
    def test_solves_a_corner(self):
        solution = poise.Solver(2).solve(corner())
        self.assertEqual(solution.status, "optimal")
        np.testing.assert_allclose(solution.y, [1, 3], atol=1e-12)
        self.assertLess(solution.certificate.worst, 1e-12)
        self.assertEqual(solution.active, [(0, 0, "upper")])
        levels = solution.levels
        np.testing.assert_allclose(
            [level.cost for level in levels], [0, 2, 0], atol=1e-12)
        np.testing.assert_allclose(levels[1].residual, [-2], atol=1e-12)
        # Stationarity of level 1: B' (B y + b) + C' mu = -2 + mu = 0.
        equalities, inequalities = solution.multipliers[1][0]
        self.assertEqual(equalities.shape, (0,))
        np.testing.assert_allclose(inequalities, [2], atol=1e-12)
        self.assertEqual(len(solution.gap), 3)

    def test_explains_which_row_is_binding(self):
        text = poise.Solver(2).solve(corner()).explain()
        self.assertIn("row 0 of B 'go right' has the residual -2", text)
        self.assertIn("binding: level 0 'limits', row 0 of C 'x', at its "
                      "upper bound 1: multiplier 2", text)
        self.assertIn("level 2: all rows are met, no binding row above", text)

    def test_a_solution_keeps_its_problem(self):
        solver = poise.Solver(2)
        solution = solver.solve(corner())
        text, gap = solution.explain(), solution.gap
        other = poise.Hierarchy(2)
        other.add_level(B=[[5, 7]], b=[1])
        solver.solve(other)
        self.assertEqual(solution.explain(), text)
        self.assertEqual([level.gap for level in solution.levels], gap)
        # The costs are numbers near 1, or zero.
        np.testing.assert_array_less(gap, 1e-9)
        self.assertEqual(repr(solution), "<poise.Solution, optimal, 3 levels>")

    def test_finds_the_conflict(self):
        solution = poise.Solver(2).solve(corner())
        self.assertEqual(solution.conflict(1),
                         ["level 0 'limits', row 0 of C 'x'",
                          "level 1 'target', row 0 of B 'go right'"])
        self.assertEqual(solution.conflict(0), [])

    def test_least_squares_agree_with_numpy(self):
        random = np.random.default_rng(1)
        B, b, weight = random.normal(size=(9, 4)), random.normal(size=9), (
            random.uniform(0.5, 2, size=9))
        hierarchy = poise.Hierarchy(4)
        hierarchy.add_level(B=B, b=b, weight=weight)
        root = np.sqrt(weight)
        y = np.linalg.lstsq(root[:, None] * B, -root * b, rcond=None)[0]
        np.testing.assert_allclose(
            poise.Solver(4).solve(hierarchy).y, y, atol=1e-12)

    def test_a_solve_with_a_budget_goes_on_where_it_ended(self):
        # A target that is far away, behind 20 bounds in other directions.
        n = 20
        hierarchy = poise.Hierarchy(n)
        hierarchy.add_level(C=np.eye(n), upper=1 + np.arange(n))
        hierarchy.add_level(B=np.ones((n, n)) + np.eye(n), b=-200 * np.ones(n))
        solver = poise.Solver(n)
        self.assertEqual(solver.max_modelled_seconds, 0)
        solver.max_modelled_seconds = 1e-6
        costs, status = [], ""
        while status != "optimal":
            solution = solver.solve(hierarchy)
            status = solution.status
            costs.append(solution.levels[1].cost)
            self.assertLess(len(costs), 100)
        self.assertGreater(len(costs), 2)
        wanted = poise.Solver(n).solve(hierarchy).levels[1].cost
        # Both are certified to 1e-9.
        np.testing.assert_allclose(costs[-1], wanted, rtol=1e-9)
        with self.assertRaisesRegex(
                poise.InputError, "max_modelled_seconds is nan.*0 or more"):
            solver.max_modelled_seconds = float("nan")

    def test_starts_from_the_last_answer(self):
        random = np.random.default_rng(2)
        hierarchy = poise.Hierarchy(20)
        hierarchy.add_level(C=random.normal(size=(60, 20)),
                            upper=np.full(60, 0.1))
        hierarchy.add_level(B=np.eye(20), b=random.normal(size=20))
        solver = poise.Solver(20)
        cold = solver.solve(hierarchy)
        warm = solver.solve(hierarchy)
        self.assertLess(warm.iterations, cold.iterations)
        self.assertLess(warm.modelled_seconds, cold.modelled_seconds)
        np.testing.assert_allclose(warm.y, cold.y, atol=1e-9)
        solver.forget()
        again = solver.solve(hierarchy)
        self.assertEqual(again.iterations, cold.iterations)
        # The prediction is exact: it depends on the work alone.
        self.assertEqual(again.modelled_seconds, cold.modelled_seconds)

    def test_accepts_larger_problems_later(self):
        solver = poise.Solver(2)
        small = poise.Hierarchy(2)
        small.add_level(B=[[1, 0]], b=[-1])
        solver.solve(small)
        np.testing.assert_allclose(solver.solve(corner()).y, [1, 3],
                                   atol=1e-12)
        empty = solver.solve(poise.Hierarchy(2))
        self.assertEqual(empty.status, "optimal")
        self.assertEqual(empty.levels, [])

    def test_reports_invalid_numbers(self):
        for arguments, status in (
                ({"B": [[np.nan, 0]]}, "not_finite"),
                ({"C": [[1, 0]], "lower": [1], "upper": [0]}, "bad_input"),
                ({"B": [[1, 0]], "weight": [-1]}, "bad_input")):
            hierarchy = poise.Hierarchy(2)
            hierarchy.add_level(**arguments)
            solution = poise.Solver(2).solve(hierarchy)
            self.assertEqual(solution.status, status)
            np.testing.assert_array_equal(solution.y, [0, 0])
            self.assertEqual(solution.conflict(0), [])
            self.assertEqual(solution.gap, [np.inf])
            self.assertIn(status, solution.explain())

    def test_two_threads_get_the_answers_of_their_own_problems(self):
        answers = {}

        def solve(wanted):
            solver, hierarchy = poise.Solver(1), poise.Hierarchy(1)
            hierarchy.add_level(B=[[1]], b=[-wanted])
            answers[wanted] = [solver.solve(hierarchy).y[0] for _ in range(50)]

        threads = [threading.Thread(target=solve, args=(wanted,))
                   for wanted in (1, 2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for wanted in (1, 2):
            np.testing.assert_allclose(answers[wanted], wanted, atol=1e-12)


class HierarchyTest(unittest.TestCase):
    def test_a_level_outlives_later_levels(self):
        hierarchy = corner()
        level = hierarchy.levels[0]
        for _ in range(20):
            hierarchy.add_level(B=np.eye(2))
        self.assertEqual(level.name, "limits")
        self.assertEqual(level.inequality_names, ["x"])
        del hierarchy
        np.testing.assert_array_equal(level.C, [[1, 0]])


class ArgumentsTest(unittest.TestCase):
    def test_wrong_shapes_are_named(self):
        hierarchy = poise.Hierarchy(2)
        for arguments, message in (
                ({"B": [[1, 0, 0]]},
                 r"B has shape \(1, 3\), must have shape \(any, 2\)"),
                ({"B": [[1, 0]], "b": [1, 2]},
                 r"b has shape \(2,\), must have shape \(1,\)"),
                ({"b": [1]}, r"b has shape \(1,\), must have shape \(0,\)"),
                ({"C": [1, 0]}, r"C has shape \(2,\)"),
                ({"C": [[1, 0]], "upper": "x"}, "upper is"),
                ({"B": [[1, 0]], "equality_names": ["a", "b"]},
                 "equality_names has 2 names, must have 1"),
                ({"B": [[1, 0]], "equality_names": "a"},
                 "equality_names is 'a'")):
            with self.assertRaisesRegex(poise.InputError, message):
                hierarchy.add_level(**arguments)
        self.assertEqual(hierarchy.levels, [])
        with self.assertRaisesRegex(
                poise.InputError, "hierarchy has 2 variables, must have 3"):
            poise.Solver(3).solve(hierarchy)
        for n in (-1, 0.5, "2", None, 10**9, 60 * "\u00e9"):
            with self.assertRaises(poise.InputError):
                poise.Hierarchy(n)
        solution = poise.Solver(2).solve(corner())
        for level in (-1, 3, "a"):
            with self.assertRaises(poise.InputError):
                solution.conflict(level)


if __name__ == "__main__":
    unittest.main()
