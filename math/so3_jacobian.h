// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

// The Jacobians of SO(3) are the derivatives of ExpSo3(). With R = R_AB =
// exp(Hat(w)), the left Jacobian gives the angular velocity in A's axes, and
// the right Jacobian in B's axes:
//     Ṙ = Hat(J_l(w) ẇ) R = R Hat(J_r(w) ẇ),
//     exp(Hat(w + d)) = exp(Hat(J_l(w) d)) R + O(|d|²).
//
// For |w| from 1e-300 to 4 π, the error of all four functions is at most 8 eps
// in the norm of the result. The error of the inverses, which exist for
// |w| < 2 π, is larger by the factor max(1, |w| / |2 π - |w||). See
// docs/generated/accuracy.md. A NaN, an infinity or |w| > 1e154 gives NaN.
// About 60 flops; no allocation.

/// Returns the left Jacobian, the sum of Hat(w)^n / (n + 1)! for n = 0, 1, ...:
///     J_l = c1 I + c2 Hat(w) + c3 w w',   with Stumpff's c1, c2, c3.
Eigen::Matrix3d LeftJacobianSo3(const Eigen::Vector3d& w) noexcept;

/// Returns the right Jacobian, J_r(w) = J_l(-w) = J_l(w)'.
Eigen::Matrix3d RightJacobianSo3(const Eigen::Vector3d& w) noexcept;

/// Returns the inverse of the left Jacobian, with θ = |w|:
///     J_l^-1 = e I - Hat(w)/2 + d w w',   e = θ/2 cot θ/2,   d = (1 - e) / θ².
Eigen::Matrix3d InverseLeftJacobianSo3(const Eigen::Vector3d& w) noexcept;

/// Returns the inverse of the right Jacobian, J_l(-w)^-1.
Eigen::Matrix3d InverseRightJacobianSo3(const Eigen::Vector3d& w) noexcept;

}  // namespace poise
