// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/pose.h"
#include "poise/math/vector6.h"

namespace poise {

// SE(3): the poses X_AB of math/pose.h, where composing, inverting and acting
// on points are. A tangent vector is x = [w; v], angular first.

/// The 4 x 4 matrix of a tangent vector: [ Hat(w)  v ]
///                                       [   0     0 ].
Eigen::Matrix4d HatSe3(const Vector6d& x) noexcept;

/// The inverse of HatSe3(); reads the antisymmetric part of the 3 x 3 block.
Vector6d VeeSe3(const Eigen::Matrix4d& W) noexcept;

/// The pose reached in unit time from the identity at the constant twist x:
///     exp(HatSe3(x)) = (ExpSo3(w), J_l(w) v).
///
/// Error at most 4 eps max(1, |w|), of rotation and translation apart, each in
/// the norm of the result, however small: about |w| = 2 π, too, where J_l(w)
/// takes what is across w to nothing. See docs/accuracy.md. A NaN, an infinity
/// or |w| > 1e154 gives NaN in all, in v in p. Does not allocate.
Pose ExpSe3(const Vector6d& x) noexcept;

/// The inverse of ExpSe3(), with |w| <= π:
///     [w; v] = [LogSo3(R); J_l(w)^-1 p].
///
/// pre: X.R is a rotation. Error at most 4 eps, of w and v apart. A NaN or an
/// infinity in R gives NaN in all, in p in v.
Vector6d LogSe3(const Pose& X) noexcept;

/// Moves twists from B to A: V_A = Ad V_B for the one motion, seen at the
/// origin and in the axes of either:
///     Ad = [    R      0 ],   X_AB = (R, p).
///          [ Hat(p) R  R ]
/// Ad(X_AB) Ad(X_BC) = Ad(X_AC); X exp(x) X^-1 = exp(Ad x).
Matrix6d Adjoint(const Pose& X_AB) noexcept;

/// Moves wrenches [moment; force] from B to A, by Ad^-T:
///     [ R  Hat(p) R ].
///     [ 0     R     ]
/// The power of a wrench along a twist is the same in A and in B.
Matrix6d DualAdjoint(const Pose& X_AB) noexcept;

/// The pose at fraction t of the screw from X_0 (t = 0) to X_1 (t = 1):
///     X_0 exp(t log(X_0^-1 X_1)).
Pose InterpolateSe3(const Pose& X_0, const Pose& X_1, double t) noexcept;

}  // namespace poise
