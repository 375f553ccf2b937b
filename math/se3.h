// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/pose.h"
#include "poise/math/vector6.h"

namespace poise {

// SE(3) is the group of the poses X_AB. math/pose.h has their product, inverse
// and action on points. A tangent vector is x = [w; v], angular first.

/// Returns the 4 x 4 matrix of a tangent vector:
///     [ Hat(w)  v ]
///     [   0     0 ].
Eigen::Matrix4d HatSe3(const Vector6d& x) noexcept;

/// Returns the tangent vector of a matrix, the inverse of HatSe3(). Only the
/// antisymmetric part of the 3 x 3 block is read.
Vector6d VeeSe3(const Eigen::Matrix4d& W) noexcept;

/// Returns the pose reached in unit time from the identity at the constant
/// twist x:
///     exp(HatSe3(x)) = (ExpSo3(w), J_l(w) v).
///
/// The errors of rotation and translation are at most 4 eps max(1, |w|), each
/// relative to its own norm. This holds near |w| = 2 π too, where J_l(w) maps
/// the normal plane of w to nearly zero. docs/generated/accuracy.md has the
/// measured errors. A NaN or an infinity in w, or |w| > 1e154, gives NaN in R
/// and p; one in v gives NaN in p. Does not allocate.
Pose ExpSe3(const Vector6d& x) noexcept;

/// Returns the twist of a pose, the inverse of ExpSe3(), with |w| <= π:
///     [w; v] = [LogSo3(R); J_l(w)^-1 p].
///
/// pre: X.R is a rotation. The errors of w and of v are at most 4 eps, each
/// relative to its own norm. A NaN or an infinity in R gives NaN in w and v;
/// one in p gives NaN in v.
Vector6d LogSe3(const Pose& X) noexcept;

/// Returns the matrix Ad that maps a twist at the origin and in the axes of B
/// to the twist of the same motion at the origin and in the axes of A, V_A = Ad
/// V_B:
///     Ad = [    R      0 ],   X_AB = (R, p).
///          [ Hat(p) R  R ]
/// Ad(X_AB) Ad(X_BC) = Ad(X_AC); X exp(x) X^-1 = exp(Ad x).
Matrix6d Adjoint(const Pose& X_AB) noexcept;

/// Returns the matrix Ad^-T that maps a wrench [moment; force] from B to A:
///     [ R  Hat(p) R ].
///     [ 0     R     ]
/// The power of a wrench along a twist is the same in A and in B.
Matrix6d DualAdjoint(const Pose& X_AB) noexcept;

/// Returns the pose at fraction t of the screw from X_0 (t = 0) to X_1 (t = 1):
///     X_0 exp(t log(X_0^-1 X_1)).
Pose InterpolateSe3(const Pose& X_0, const Pose& X_1, double t) noexcept;

}  // namespace poise
