# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Calls everything public with random arguments, most of them invalid.

Each call returns a result or raises InputError or TypeError; no call aborts.
POISE_SEED=N in the environment draws other arguments.
"""

import collections
import faulthandler
import inspect
import os
import tempfile
import types
import unittest

import numpy as np

import poise

faulthandler.enable()  # Prints the Python stack of a crash.

CALLS = 60  # Of each function.
ROBOT = poise.Robot.load()
TREE = ROBOT.tree
SHAPES = [(), (0,), (1,), (2,), (3,), (4,), (6,), (2, 2), (1, 3), (3, 3),
          (4, 4), (0, 2), (2, 0), (3, 3, 3), (TREE.nq,), (TREE.nv,),
          (TREE.num_joints,), (1, TREE.nq), (TREE.nv, 1), (TREE.num_bodies, 6),
          (6, TREE.num_bodies), (TREE.nv, TREE.nv)]
DTYPES = ["f8", "f8", "f8", "f4", ">f8", "f2", "i4", "u1", "?", "c16", "O",
          "U3", "M8[s]", "f8,i4"]


def hierarchy():
    """Returns a hierarchy in two variables."""
    made = poise.Hierarchy(2)
    made.add_level(C=[[1, 0]], upper=[1])
    made.add_level(B=np.eye(2), b=[-2, -3])
    return made


def random_array(random):
    """Returns an array of any shape, type and layout."""
    shape = SHAPES[random.integers(len(SHAPES))]
    array = np.asarray(random.normal(size=shape))
    if random.random() < 0.1:
        array = array * np.inf  # NaN too, where the array has zeros.
    elif random.random() < 0.1:
        array = np.full(shape, np.nan)
    dtype = np.dtype(DTYPES[random.integers(len(DTYPES))])
    if dtype.kind in "MV":  # Times and records.
        array = np.zeros(shape, dtype)
    elif dtype.kind in "iu?":
        array = np.full(shape, random.integers(3), dtype)
    else:
        array = np.asarray(array).astype(dtype)
    array = np.asarray(array)
    layout = random.integers(6)
    if layout == 0:
        return np.asfortranarray(array)
    if layout == 1 and array.ndim:
        return np.repeat(array, 2, axis=0)[::2]
    if layout == 2 and array.ndim:
        return array[::-1]
    if layout == 3 and array.size:
        return np.broadcast_to(array.flat[0], shape)  # Its strides are 0.
    if layout == 4 and array.ndim:
        array.flags.writeable = False
    return array


def random_object(random):
    """Returns an argument that is not an array."""
    pool = [None, True, False, np.bool_(True), -1, 0, 2, 0.5, np.nan, -np.inf,
            1e308, 10**400, "text", "", "world", "posture", "\ud800", "a\0b",
            b"bytes", object(), [], (), {}, {"a": 1}, {1: "a"}, [[1], [2, 3]],
            ["text"], [None], [[]], [1, 2], (1.0, 2.0, 3.0), np.float32(3), 1j,
            range(3), ROBOT, TREE, ROBOT.feet[0], hierarchy(),
            poise.Task("t", ["a"]),
            poise.State(ROBOT.posture, np.zeros(TREE.nv)), int, len]
    return pool[random.integers(len(pool))]


# A valid argument for each name of a parameter. Other names get any argument.
VALID = {
    "q": ROBOT.posture, "v": np.linspace(-1, 1, TREE.nv),
    "vdot": np.zeros(TREE.nv), "tau": np.zeros(TREE.nv),
    "q_from": ROBOT.posture, "q_to": ROBOT.posture, "dt": 0.1, "frame": 0,
    "frames": [0, 1], "axes": "frame", "forces": np.ones((TREE.num_bodies, 6)),
    "w": [1, 2, 3], "x": [1, 2, 3, 4, 5, 6], "rpy": [1, 2, 3], "t": 0.5,
    "R": np.eye(3), "R_0": np.eye(3), "R_1": np.eye(3), "X": np.eye(4),
    "X_0": np.eye(4), "X_1": np.eye(4), "W": np.zeros((4, 4)),
    "quaternion": [0, 0, 0, 2], "force": [0, 9, 0], "moment": [0, 0, 1],
    "at": 0.5, "duration": 0.1, "link": "", "point": [0, 0, 0],
    "profile": "half_sine", "B": np.eye(2), "b": [1, 2], "C": np.ones((3, 2)),
    "lower": [-1, -1, -1], "upper": np.ones(3), "weight": [1, 2], "level": 1,
    "robot": ROBOT, "n": 2, "friction": 0.5, "max_iterations": 9, "tasks": [],
    "state": poise.State(ROBOT.posture, np.zeros(TREE.nv)), "time": 0.1,
    "equalities": ["a"], "inequalities": ("b",), "locked": {}, "values": {},
    "library": "drake", "M": np.eye(TREE.nv), "J": np.zeros((6, TREE.nv)),
    "base": "fixed",
}


def random_argument(name, random):
    """Returns an argument, valid in about half of the calls."""
    if name in VALID and random.random() < 0.75:
        return VALID[name]
    return (random_array if random.random() < 0.6 else random_object)(random)


def parameters(function):
    """Returns the names of the parameters, without self."""
    return [name for name, parameter in
            inspect.signature(function).parameters.items()
            if name != "self" and parameter.kind != parameter.VAR_POSITIONAL]


def instances():
    """Returns an object of each class with functions."""
    simulation = poise.Simulation(
        ROBOT, poise.Scenario.from_dict({"duration": 0.01}))
    state = poise.State(ROBOT.posture, np.zeros(TREE.nv))
    controller = poise.Controller(ROBOT)
    controller.start(state)
    stack = controller.stack
    scenario = poise.Scenario.from_dict({"duration": 0.01})
    return [ROBOT, TREE, hierarchy(), poise.Solver(2),
            poise.Solver(2).solve(hierarchy()), state, controller, stack,
            stack["posture"], stack["posture"].parameters, scenario,
            simulation, poise.Task("t", ["a"]), poise.run(scenario, ROBOT)]


def functions():
    """Yields (name, function, names of its parameters)."""
    for group in ("so3", "se3"):
        module = getattr(poise, group)
        for name, function in vars(module).items():
            if callable(function):
                yield f"{group}.{name}", function, parameters(function)
    for name in ("doctor", "run"):
        yield name, getattr(poise, name), parameters(getattr(poise, name))
    for thing in instances():
        kind = type(thing)
        if kind.__init__ is not object.__init__ and kind is not poise.Run:
            try:
                yield kind.__name__, kind, parameters(kind.__init__)
            except (AttributeError, TypeError):
                pass
        for name, member in vars(kind).items():
            label = f"{kind.__name__}.{name}"
            if name in ("__getitem__", "__contains__", "__setitem__"):
                yield label, getattr(thing, name), (
                    ["name", "value"] if name == "__setitem__" else ["name"])
            elif name.startswith("_"):
                continue
            elif isinstance(member, property):
                if member.fset:
                    yield label, setter(thing, name), ["value"]
            elif callable(getattr(thing, name)):
                function = getattr(thing, name)
                yield label, function, parameters(function)


def setter(thing, name):
    """Returns a function that sets a property."""
    return lambda value: setattr(thing, name, value)


class ArgumentsTest(unittest.TestCase):
    def setUp(self):
        # Run.report() may write a file of any name.
        place = tempfile.TemporaryDirectory(dir=os.environ.get("TEST_TMPDIR"))
        self.addCleanup(place.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(place.name)

    def call(self, label, function, names, random):
        """Calls a function once; returns whether it had a result."""
        given = [random_argument(name, random) for name in names]
        if random.random() < 0.2 and given:
            given = given[:random.integers(len(given))]
        by_name = dict(zip(names, given))
        try:
            if label.endswith("__"):
                function(*given)
            else:
                function(**by_name)
        except poise.InputError:
            return False
        except TypeError as error:
            # Python's own error for arguments that are missing.
            if len(given) == len(names) and "No constructor" not in str(error):
                raise AssertionError(f"{label}({by_name!r}) raised {error!r}"
                                     ) from error
            return False
        except BaseException as error:
            raise AssertionError(f"{label}({by_name!r}) raised {error!r}"
                                 ) from error
        return True

    def test_any_argument_gives_a_result_or_an_input_error(self):
        random = np.random.default_rng(int(os.environ.get("POISE_SEED", "1")))
        results, count = 0, 0
        for label, function, names in functions():
            if not names:
                continue
            count += 1
            for _ in range(CALLS):
                results += self.call(label, function, names, random)
        # Both kinds of calls must occur, and no class may be left out.
        self.assertGreater(count, 80)
        self.assertGreater(results, CALLS * count / 10)
        self.assertLess(results, CALLS * count / 2)

    def test_any_rows_of_a_task_give_a_command(self):
        random = np.random.default_rng(3)

        class Anything(poise.Task):
            def rows(self, input):
                names = ("B", "b", "C", "lower", "upper", "D")
                some = random.permutation(names)[:random.integers(7)]
                values = [random_argument("", random) for _ in some]
                return (dict(zip(some, values)) if random.random() < 0.5
                        else tuple(values))

        task = Anything("anything", ["a"], ["b"])
        controller = poise.Controller(ROBOT, tasks=[task])
        state = poise.State(ROBOT.posture, np.zeros(TREE.nv))
        controller.start(state)
        errors = 0
        for tick in range(1, 100):
            state.time = 1e-3 * tick
            command = controller.update(state)
            self.assertTrue(np.isfinite(command.tau).all())
            errors += bool(task.error)
            self.assertEqual(command.status == "fail_safe", bool(task.error)
                             or controller.report.solver_status in (
                                 "not_finite", "bad_input"))
        self.assertGreater(errors, 50)

    def test_any_layout_gives_the_same_result(self):
        random = np.random.default_rng(2)
        q = TREE.integrate(ROBOT.posture, random.normal(size=TREE.nv), 0.3)
        v = random.normal(size=TREE.nv)
        expected = TREE.bias(q, v)
        for q_as, v_as in (
                (np.repeat(q, 2)[::2], np.repeat(v, 3)[::3]),
                (q[::-1].copy()[::-1], v.astype(">f8")),
                (list(q), tuple(v)), (memoryview(q), v)):
            np.testing.assert_array_equal(TREE.bias(q_as, v_as), expected)
        X = poise.se3.exp(v[:6])
        for same in (np.asfortranarray(X), X.T.copy().T, X.tolist(),
                     np.pad(X, 2)[2:-2, 2:-2]):
            np.testing.assert_array_equal(poise.se3.log(same),
                                          poise.se3.log(X))

    def test_members_before_init_raise_an_error(self):
        for name in poise.__all__:
            kind = getattr(poise, name)
            if not isinstance(kind, type) or kind in (poise.InputError,
                                                      poise.Run):
                continue
            for member, value in vars(kind).items():
                if isinstance(value, property):
                    with self.subTest(name=f"{name}.{member}"):
                        with self.assertRaises((poise.InputError,
                                                RuntimeError)):
                            getattr(kind.__new__(kind), member)
            with self.assertRaises((poise.InputError, RuntimeError)):
                repr(kind.__new__(kind))

    def test_numbers_are_real_and_single(self):
        for number in (1 + 2j, np.complex128(1), np.complex64(1), "1",
                       np.array("1"), np.array([1.0]), [1.0], None):
            with self.subTest(number=number):
                with self.assertRaisesRegex(poise.InputError, "real number"):
                    poise.State(ROBOT.posture, np.zeros(TREE.nv), number)
        with self.assertRaisesRegex(poise.InputError, "of magnitude below 1.8e308"):
            poise.State(ROBOT.posture, np.zeros(TREE.nv), 10**400)
        for number in (2, True, np.float32(2), np.int8(2), np.array(2.0)):
            state = poise.State(ROBOT.posture, np.zeros(TREE.nv), number)
            self.assertEqual(state.time, number)

    def test_mappings_and_sequences_are_dicts_and_lists(self):
        values = types.MappingProxyType({"duration": 3})
        self.assertEqual(poise.Scenario.from_dict(values).duration, 3)
        values = {"duration": 3}
        poise.Scenario.from_dict(values)
        self.assertIn("'b'", repr(poise.Scenario.from_dict(values, name="b")))
        self.assertEqual(values, {"duration": 3})
        with self.assertRaisesRegex(poise.InputError, "'name' is '..'"):
            poise.Scenario.from_dict({}, name="..")
        names = collections.deque(["a"])
        self.assertEqual(poise.Task("t", names).name, "t")
        for names in ("ab", b"ab", range(1)):
            with self.assertRaises(poise.InputError):
                poise.Task("t", names)

    def test_flags_and_mappings_are_named(self):
        stack = poise.Controller(ROBOT).stack
        scenario = poise.Scenario.load("stand")
        q, v = ROBOT.posture, np.zeros(TREE.nv)
        for call, message in (
                (lambda: TREE.bias(q, v, gravity=[0, 0, -9.81]),
                 "gravity is .* of type list, must be True or False"),
                (lambda: poise.Tree.load(ROBOT.urdf, locked=["neck_yaw"]),
                 "locked is of type list, must be a dict"),
                (lambda: poise.Tree.load(ROBOT.urdf, locked={"neck_yaw": "x"}),
                 r"locked\['neck_yaw'\] is 'x'"),
                (lambda: poise.Tree.load(ROBOT.urdf, locked={"nose": 0}),
                 "nose"),
                (lambda: setattr(scenario, "steps", "on"), "steps is 'on'"),
                (lambda: setattr(stack["posture"], "enabled", None),
                 "enabled is None"),
                (lambda: poise.run(scenario, ROBOT, binary="yes"),
                 "binary is 'yes'")):
            with self.assertRaisesRegex(poise.InputError, message):
                call()

    def test_locked_joints_are_not_in_the_tree(self):
        tree = poise.Tree.load(ROBOT.urdf, locked={"neck_yaw": 0.1})
        free = poise.Tree.load(ROBOT.urdf)
        self.assertEqual(set(free.joint_names) - set(tree.joint_names),
                         {"neck_yaw"})
        self.assertAlmostEqual(tree.total_mass, free.total_mass)


if __name__ == "__main__":
    unittest.main()
