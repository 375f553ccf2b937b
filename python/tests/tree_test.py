# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.Tree: its algorithms agree with each other and with NumPy."""

import os
import pathlib
import tempfile
import unittest

import numpy as np

import poise

ROBOT = poise.Robot.load()
TREE = ROBOT.tree

LIGHT = """<robot name="light"><link name="a"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="b"/><joint name="j" type="continuous"><parent link="a"/>
<child link="b"/><axis xyz="0 0 1"/></joint></robot>"""


def state(seed=0):
    """Returns (q, v, vdot) near the standing posture."""
    random = np.random.default_rng(seed)
    q = TREE.integrate(ROBOT.posture, random.uniform(-1, 1, TREE.nv), 0.3)
    return q, random.uniform(-1, 1, TREE.nv), random.uniform(-1, 1, TREE.nv)


def difference(function, h=1e-6):
    """Returns the derivative of function(d) at d = 0, by columns."""
    return np.column_stack([
        (function(h * d) - function(-h * d)) / (2 * h)
        for d in np.eye(TREE.nv)])


class EquationOfMotionTest(unittest.TestCase):
    def test_rnea_is_mass_times_acceleration_plus_bias(self):
        q, v, vdot = state()
        tau = TREE.crba(q) @ vdot + TREE.bias(q, v)
        np.testing.assert_allclose(TREE.rnea(q, v, vdot), tau, atol=1e-10)

    def test_aba_inverts_rnea(self):
        q, v, vdot = state()
        np.testing.assert_allclose(
            TREE.aba(q, v, TREE.rnea(q, v, vdot)), vdot, atol=1e-9)

    def test_gravity_pulls_the_mass(self):
        q, v, _ = state()
        gravity = TREE.bias(q, v) - TREE.bias(q, v, gravity=False)
        np.testing.assert_allclose(
            gravity[3:6], -TREE.total_mass * TREE.gravity, atol=1e-10)

    def test_forces_act_by_the_jacobian(self):
        q, v, vdot = state()
        forces = np.zeros((TREE.num_bodies, 6))
        forces[0] = [1, 2, 3, 4, 5, 6]  # On the base, whose origin is p_WB.
        tau = TREE.rnea(q, v, vdot) - TREE.rnea(q, v, vdot, forces)
        np.testing.assert_allclose(tau[:6], forces[0], atol=1e-10)
        np.testing.assert_allclose(tau[6:], 0, atol=1e-10)
        np.testing.assert_allclose(
            TREE.aba(q, v, TREE.rnea(q, v, vdot, forces), forces), vdot,
            atol=1e-9)

    def test_kinetic_energy_is_quadratic(self):
        q, v, _ = state()
        self.assertAlmostEqual(
            TREE.kinetic_energy(q, v), v @ TREE.crba(q) @ v / 2, places=10)


class KinematicsTest(unittest.TestCase):
    def test_jacobian_is_the_difference_of_poses(self):
        q, _, _ = state()
        frame = TREE.frame_names[-1]
        pose = TREE.pose(q, frame)

        def twist(d):
            moved = TREE.pose(TREE.integrate(q, d, 1), frame)
            return np.concatenate([
                poise.so3.log(moved[:3, :3] @ pose[:3, :3].T),
                moved[:3, 3] - pose[:3, 3]])

        # The errors of central differences are about 1e-10.
        np.testing.assert_allclose(
            TREE.jacobian(q, frame), difference(twist), atol=1e-8)
        R = pose[:3, :3].T
        np.testing.assert_allclose(
            TREE.jacobian(q, frame, axes="frame"),
            np.kron(np.eye(2), R) @ TREE.jacobian(q, frame), atol=1e-12)

    def test_jacobian_bias_is_the_rate_of_the_velocity(self):
        q, v, _ = state()
        frame = TREE.frame_names[-1]

        def velocity(t):
            return TREE.jacobian(TREE.integrate(q, v, t), frame) @ v

        rate = (velocity(1e-6) - velocity(-1e-6)) / 2e-6
        np.testing.assert_allclose(
            TREE.jacobian_bias(q, v, frame), rate, atol=1e-7)

    def test_difference_inverts_integrate(self):
        q, v, _ = state()
        np.testing.assert_allclose(
            TREE.difference(q, TREE.integrate(q, v, 0.5)), 0.5 * v, atol=1e-12)

    def test_neutral_is_at_the_origin(self):
        expected = np.zeros(TREE.nq)
        expected[6] = 1
        np.testing.assert_array_equal(TREE.neutral(), expected)


class MomentumTest(unittest.TestCase):
    def test_com_jacobian_is_the_difference_of_positions(self):
        q, v, _ = state()
        com = TREE.com(q, v)
        np.testing.assert_allclose(
            com.J, difference(lambda d: TREE.com(TREE.integrate(q, d, 1)).p),
            atol=1e-8)
        np.testing.assert_allclose(com.v, com.J @ v, atol=1e-12)

    def test_linear_momentum_is_mass_times_velocity(self):
        q, v, _ = state()
        momentum = TREE.centroidal(q, v)
        np.testing.assert_allclose(
            momentum.H[3:] @ v, TREE.total_mass * TREE.com(q, v).v, atol=1e-10)
        np.testing.assert_allclose(
            momentum.bias[3:], TREE.total_mass * TREE.com(q, v).bias,
            atol=1e-9)

    def test_results_outlive_their_owner(self):
        J = TREE.com(state()[0]).J
        self.assertEqual(J.shape, (3, TREE.nv))
        self.assertFalse(J.flags.writeable)


class DerivativesTest(unittest.TestCase):
    def test_are_differences_of_rnea(self):
        q, v, vdot = state()
        d = TREE.derivatives(q, v, vdot)
        # Differences of torques of 1000 N m have errors of about 1e-6.
        np.testing.assert_allclose(
            d.dq, difference(
                lambda x: TREE.rnea(TREE.integrate(q, x, 1), v, vdot)),
            atol=1e-5)
        np.testing.assert_allclose(
            d.dv, difference(lambda x: TREE.rnea(q, v + x, vdot)), atol=1e-5)
        np.testing.assert_allclose(d.dvdot, TREE.crba(q), atol=1e-10)

    def test_regressor_times_parameters_is_rnea(self):
        q, v, vdot = state()
        np.testing.assert_allclose(
            TREE.regressor(q, v, vdot) @ TREE.inertial_parameters(),
            TREE.rnea(q, v, vdot), atol=1e-9)


class TickTest(unittest.TestCase):
    def test_has_what_the_other_algorithms_give(self):
        q, v, _ = state()
        feet = [TREE.frame_names[foot.frame] for foot in ROBOT.feet]
        tick = TREE.tick(q, v, feet)
        np.testing.assert_allclose(tick.M, TREE.crba(q), atol=1e-10)
        np.testing.assert_allclose(tick.N, TREE.bias(q, v), atol=1e-10)
        np.testing.assert_allclose(
            tick.H_G, TREE.centroidal(q, v).H, atol=1e-10)
        np.testing.assert_allclose(tick.com, TREE.com(q).p, atol=1e-12)
        for frame, name in zip(tick.frames, feet):
            np.testing.assert_allclose(
                frame.J, TREE.jacobian(q, name), atol=1e-12)
            np.testing.assert_allclose(
                frame.Jdot_v, TREE.jacobian_bias(q, v, name), atol=1e-10)
            np.testing.assert_allclose(
                frame.X, TREE.pose(q, name), atol=1e-12)

    def test_overwrites_out(self):
        q, v, _ = state()
        tick = TREE.tick(q, v)
        M = tick.M
        other, w, _ = state(1)
        self.assertIs(TREE.tick(other, w, out=tick), tick)
        np.testing.assert_array_equal(M, TREE.tick(other, w).M)


class BaseTest(unittest.TestCase):
    def test_a_fixed_base_has_the_joints_only(self):
        q, v, vdot = state()
        q[:7] = TREE.neutral()[:7]
        v[:6] = vdot[:6] = 0
        arm = TREE.with_base("fixed")
        self.assertEqual((arm.nq, arm.nv, arm.is_floating),
                         (TREE.num_joints, TREE.num_joints, False))
        np.testing.assert_allclose(arm.rnea(q[7:], v[6:], vdot[6:]),
                                   TREE.rnea(q, v, vdot)[6:], atol=1e-9)
        self.assertEqual(arm.with_base("floating").nq, TREE.nq)
        self.assertRegex(repr(arm), "^<poise.Tree, 50 joints, base fixed, ")
        with self.assertRaisesRegex(poise.InputError, "base is 'table'"):
            TREE.with_base("table")


class ConventionsTest(unittest.TestCase):
    def test_orders_are_those_of_the_libraries(self):
        q, v, _ = state()
        p, xyz, w = q[:3], q[3:6], q[6:7]
        for library, base in (("pinocchio", (p, xyz, w)),
                              ("drake", (w, xyz, p)),
                              ("mujoco", (p, w, xyz))):
            np.testing.assert_allclose(
                TREE.export_configuration(library, q)[:7],
                np.concatenate(base), atol=1e-12)
        np.testing.assert_allclose(
            TREE.export_velocity("mujoco", q, v)[:3], v[3:6], atol=1e-12)

    def test_import_inverts_export(self):
        q, v, vdot = state()
        M, J = TREE.crba(q), TREE.jacobian(q, 1)
        for library in ("pinocchio", "drake", "mujoco"):
            for name, arguments in {
                    "velocity": (q, v), "acceleration": (q, v, vdot),
                    "forces": (q, vdot), "mass_matrix": (q, M),
                    "bias": (q, v, M, vdot),
                    "jacobian": (q, J), "configuration": (q,)}.items():
                theirs = getattr(TREE, "export_" + name)(library, *arguments)
                ours = getattr(TREE, "import_" + name)(
                    library, *arguments[:-1], theirs)
                np.testing.assert_allclose(ours, arguments[-1], atol=1e-9)
        with self.assertRaisesRegex(poise.InputError, "library is 'tsid'"):
            TREE.export_configuration("tsid", q)

    def test_energy_is_the_same_in_each_library(self):
        q, v, _ = state()
        theirs = TREE.export_velocity("pinocchio", q, v)
        M = TREE.export_mass_matrix("pinocchio", q, TREE.crba(q))
        self.assertAlmostEqual(theirs @ M @ theirs / 2,
                               TREE.kinetic_energy(q, v), places=9)

    def test_the_equation_of_motion_holds_in_each_library(self):
        q, v, vdot = state()
        M, N, tau = TREE.crba(q), TREE.bias(q, v), TREE.rnea(q, v, vdot)
        for library in ("pinocchio", "drake", "mujoco"):
            np.testing.assert_allclose(
                TREE.export_mass_matrix(library, q, M)
                @ TREE.export_acceleration(library, q, v, vdot)
                + TREE.export_bias(library, q, v, M, N),
                TREE.export_forces(library, q, tau), atol=1e-9)


class ArgumentsTest(unittest.TestCase):
    def test_wrong_shapes_are_named(self):
        q, v, vdot = state()
        nq, nv = TREE.nq, TREE.nv
        for call, message in (
                (lambda: TREE.crba(v),
                 rf"q has shape \({nv},\), must have shape \({nq},\)"),
                (lambda: TREE.rnea(q, v, q),
                 rf"vdot has shape \({nq},\), must have shape \({nv},\)"),
                (lambda: TREE.rnea(q, v, v, np.zeros((3, 6))),
                 rf"forces has shape \(3, 6\), must have shape "
                 rf"\({TREE.num_bodies}, 6\)"),
                (lambda: TREE.crba(q[None]), rf"q has shape \(1, {nq}\)"),
                (lambda: TREE.jacobian(q, "nose"),
                 "frame 'nose' is unknown, must be one of .*head"),
                (lambda: TREE.jacobian(q, -1), "frame is -1"),
                (lambda: TREE.jacobian(q, 10**6), "frame is 1000000"),
                (lambda: TREE.jacobian(q, 0.5), "frame is 0.5"),
                (lambda: TREE.jacobian(q, 0, "base"), "axes is 'base'"),
                (lambda: TREE.integrate(q, v, None), "dt is None"),
                (lambda: TREE.tick(q, v, "nose"),
                 "frames is 'nose', must be a list"),
                (lambda: TREE.tick(q, v, out=3), "out is 3, must be a Tick"),
                (lambda: TREE.aba(q, v, "tau"), r"tau is .* must be real")):
            with self.assertRaisesRegex(poise.InputError, message):
                call()

    def test_nan_gives_nan(self):
        q, v, vdot = state()
        nan = np.full(TREE.nq, np.nan)
        self.assertTrue(np.isnan(TREE.rnea(nan, v, vdot)).any())
        self.assertTrue(np.isnan(TREE.aba(nan, v, vdot)).all())
        tick = TREE.tick(nan, v)
        for name, values in {
                "crba": TREE.crba(nan), "M": tick.M, "N": tick.N,
                "dq": TREE.derivatives(nan, v, vdot).dq,
                "regressor": TREE.regressor(nan, v, vdot),
                "integrate": TREE.integrate(nan, v, 1),
                "pose": TREE.pose(nan, 0)}.items():
            self.assertTrue(np.isnan(values).any(), name)

    def test_a_joint_without_mass_is_named(self):
        with tempfile.TemporaryDirectory(
                dir=os.environ.get("TEST_TMPDIR")) as folder:
            file = pathlib.Path(folder, "light.urdf")
            file.write_text(LIGHT)
            tree = poise.Tree.load(file)
            q, v = tree.neutral(), np.zeros(tree.nv)
            with self.assertRaisesRegex(
                    poise.InputError, "joint 'j': .*locked={'j': 0}"):
                tree.aba(q, v, v)
            tree = poise.Tree.load(file, locked={"j": 0})
            self.assertTrue(np.isfinite(tree.aba(q[:-1], v[:-1], v[:-1])).all())
            with self.assertRaisesRegex(
                    poise.InputError, "locked has 'nose', .*light.urdf"):
                poise.Tree.load(file, locked={"nose": 0})


if __name__ == "__main__":
    unittest.main()
