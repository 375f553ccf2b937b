# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests poise.so3 and poise.se3 against series of matrices in NumPy."""

import unittest

import numpy as np

import poise
from poise import se3, so3

W = np.array([0.3, -0.5, 0.8])
X = np.array([0.3, -0.5, 0.8, 1.0, 2.0, -0.4])


def exp_by_series(matrix):
    """Returns the exponential of a matrix; its norm is below 4."""
    power = total = np.eye(len(matrix))
    for n in range(1, 60):
        power = power @ matrix / n
        total = total + power
    return total


class So3Test(unittest.TestCase):
    def test_exp_is_the_series_of_hat(self):
        np.testing.assert_allclose(
            so3.exp(W), exp_by_series(so3.hat(W)), atol=1e-14)

    def test_hat_is_the_cross_product(self):
        v = np.array([1.0, 2.0, 3.0])
        np.testing.assert_array_equal(so3.hat(W) @ v, np.cross(W, v))

    def test_log_and_vee_invert(self):
        np.testing.assert_allclose(so3.log(so3.exp(W)), W, atol=1e-14)
        np.testing.assert_array_equal(so3.vee(so3.hat(W)), W)

    def test_jacobians_are_differences_of_exp(self):
        for column in range(3):
            d = np.zeros(3)
            d[column] = 1e-6
            change = (so3.exp(W + d) - so3.exp(W - d)) / 2e-6
            # Central differences have an error of about 1e-10 here.
            np.testing.assert_allclose(
                so3.vee(change @ so3.exp(W).T),
                so3.left_jacobian(W)[:, column], atol=1e-9)
            np.testing.assert_allclose(
                so3.vee(so3.exp(W).T @ change),
                so3.right_jacobian(W)[:, column], atol=1e-9)
        for j, inverse in ((so3.left_jacobian, so3.inverse_left_jacobian),
                           (so3.right_jacobian, so3.inverse_right_jacobian)):
            np.testing.assert_allclose(j(W) @ inverse(W), np.eye(3),
                                       atol=1e-14)

    def test_quaternion_has_the_real_part_last(self):
        half = np.linalg.norm(W) / 2
        axis = W / np.linalg.norm(W)
        np.testing.assert_allclose(
            so3.quaternion(so3.exp(W)),
            [*(np.sin(half) * axis), np.cos(half)], atol=1e-14)
        np.testing.assert_allclose(
            so3.matrix(3 * so3.quaternion(so3.exp(W))), so3.exp(W), atol=1e-14)

    def test_nan_gives_nan(self):
        self.assertTrue(np.isnan(so3.exp([np.nan, 0, 0])).all())
        self.assertTrue(np.isnan(so3.project(np.full((3, 3), np.nan))).all())


class Se3Test(unittest.TestCase):
    def test_exp_is_the_series_of_hat(self):
        np.testing.assert_allclose(
            se3.exp(X), exp_by_series(se3.hat(X)), atol=1e-13)

    def test_log_and_vee_invert(self):
        np.testing.assert_allclose(se3.log(se3.exp(X)), X, atol=1e-13)
        np.testing.assert_array_equal(se3.vee(se3.hat(X)), X)

    def test_adjoint_moves_the_exponent(self):
        pose = se3.exp(X)
        y = np.array([0.1, 0.2, -0.3, 0.5, 0.1, 0.2])
        np.testing.assert_allclose(
            pose @ se3.exp(y) @ se3.inverse(pose),
            se3.exp(se3.adjoint(pose) @ y), atol=1e-13)
        np.testing.assert_allclose(
            se3.dual_adjoint(pose), np.linalg.inv(se3.adjoint(pose)).T,
            atol=1e-13)

    def test_left_jacobian_is_the_series_of_ad(self):
        ad = np.block([[so3.hat(X[:3]), np.zeros((3, 3))],
                       [so3.hat(X[3:]), so3.hat(X[:3])]])
        term, total = np.eye(6), np.eye(6)
        for n in range(2, 60):
            term = term @ ad / n
            total = total + term
        np.testing.assert_allclose(se3.left_jacobian(X), total, atol=1e-13)
        np.testing.assert_allclose(
            se3.right_jacobian(X), se3.left_jacobian(-X), atol=1e-14)


class ArgumentsTest(unittest.TestCase):
    """Wrong arguments raise InputError, which names both shapes."""

    def test_names_both_shapes(self):
        with self.assertRaisesRegex(
                poise.InputError,
                r"w has shape \(4,\), must have shape \(3,\)"):
            so3.exp(np.zeros(4))
        with self.assertRaisesRegex(
                poise.InputError,
                r"X has shape \(3, 3\), must have shape \(4, 4\)"):
            se3.log(np.eye(3))

    def test_rejects_what_is_not_real(self):
        for value in (None, "abc", ["1", "2", "3"], [1j, 0, 0], object(),
                      {}, [[1], [1, 2]], [None, 1, 2], [True, False, True]):
            with self.subTest(value=value):
                with self.assertRaisesRegex(
                        poise.InputError, r"w is .*shape \(3,\)"):
                    so3.exp(value)
        with self.assertRaisesRegex(poise.InputError, "t is '1' of type str"):
            so3.interpolate(np.eye(3), np.eye(3), "1")

    def test_is_a_value_error(self):
        self.assertTrue(issubclass(poise.InputError, ValueError))

    def test_accepts_numbers_in_any_layout(self):
        strided = np.array([0.3, 9, -0.5, 9, 0.8, 9])[::2]
        big_endian = W.astype(">f8")
        for value in (list(W), tuple(W), strided, big_endian):
            np.testing.assert_array_equal(so3.exp(value), so3.exp(W))
        np.testing.assert_array_equal(
            so3.exp([1, 0, 0]), so3.exp(np.array([1.0, 0, 0])))
        R = so3.exp(W)
        np.testing.assert_array_equal(
            so3.log(np.asfortranarray(R)), so3.log(R))


if __name__ == "__main__":
    unittest.main()
