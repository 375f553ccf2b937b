// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/math/vector6.h"

namespace poise {

// The Jacobians of SE(3) are the derivatives of ExpSe3() at x = [w; v]. With X
// = exp(HatSe3(x)), the twist V of X in A's axes at A's origin, and the twist
// V_B in B's axes at B's origin,
//     V = J_l(x) ẋ,   V_B = J_r(x) ẋ,
//     exp(x + d) = exp(J_l(x) d) exp(x) + O(|d|²).
//
// The matrix
//     ad(x) = [ Hat(w)    0    ]
//             [ Hat(v)  Hat(w) ]
// is Hat(w) + ε Hat(v) with a dual unit ε, and J_l = sum of ad^n / (n + 1)! is
// a function of ad(x). Therefore
//     J_l(x) = [ J  0 ],   J = LeftJacobianSo3(w),
//              [ Q  J ]
// where Q is the derivative of J at w in the direction v. Q needs no product of
// matrices. With Stumpff's c1, c2, c3, ' for 2 d/ds, and k = w'v,
//     Q = c1' k I + c2 Hat(v) + c2' k Hat(w) + c3 (v w' + w v') + c3' k w w'.
// The inverse has the same form, with e, -1/2 and d for c1, c2 and c3.
//
// The error of all four functions is at most 8 eps in the norm of the result,
// as for SO(3). See docs/generated/accuracy.md. A NaN, an infinity or |w| >
// 1e154 gives NaN. About 150 flops; no allocation.
//
// Source: Barfoot, State Estimation for Robotics, 2017, (7.86), which gives Q
// as products of matrices. A test compares both forms.

/// Returns the left Jacobian.
Matrix6d LeftJacobianSe3(const Vector6d& x) noexcept;

/// Returns the right Jacobian, J_r(x) = J_l(-x).
Matrix6d RightJacobianSe3(const Vector6d& x) noexcept;

/// Returns the inverse of the left Jacobian, for |w| < 2 π.
Matrix6d InverseLeftJacobianSe3(const Vector6d& x) noexcept;

/// Returns the inverse of the right Jacobian, for |w| < 2 π.
Matrix6d InverseRightJacobianSe3(const Vector6d& x) noexcept;

}  // namespace poise
