// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/stumpff.h"

namespace poise {

// SO(3) is the group of the rotations R_AB: R_AC = R_AB R_BC, R_BA = R_AB', and
// v_A = R_AB v_B. The adjoint of R and its dual are R.

/// Returns the matrix of the cross product: Hat(w) v = w x v.
inline Eigen::Matrix3d Hat(const Eigen::Vector3d& w) noexcept {
  Eigen::Matrix3d W;
  W << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return W;
}

/// Returns the vector of the antisymmetric part (W - W')/2, the inverse of
/// Hat().
inline Eigen::Vector3d Vee(const Eigen::Matrix3d& W) noexcept {
  return 0.5 * Eigen::Vector3d(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0),
                               W(1, 0) - W(0, 1));
}

/// Returns the rotation by |w| about w, for any |w|:
///     exp(Hat(w)) = I + sin θ / θ Hat(w) + (1 - cos θ) / θ² Hat(w)², θ = |w|.
///
/// The error is at most 4 eps max(1, |w|) in the norm of the result. The error
/// of the antisymmetric part has this bound relative to |w| too, down to |w| =
/// 1e-300. See docs/generated/accuracy.md. A NaN, an infinity or |w| > 1e154
/// gives NaN in all entries.
inline Eigen::Matrix3d ExpSo3(const Eigen::Vector3d& w) noexcept {
  const Stumpff c = ComputeStumpff(w);
  const double x = w.x(), y = w.y(), z = w.z();
  const double xy = c.c2 * x * y, xz = c.c2 * x * z, yz = c.c2 * y * z;
  Eigen::Matrix3d R;
  R << 1 - c.c2 * (y * y + z * z), xy - c.c1 * z, xz + c.c1 * y, xy + c.c1 * z,
      1 - c.c2 * (x * x + z * z), yz - c.c1 * x, xz - c.c1 * y, yz + c.c1 * x,
      1 - c.c2 * (x * x + y * y);
  return R;
}

/// Returns the rotation vector of R, of norm at most π, the inverse of
/// ExpSo3(). A rotation by π has two rotation vectors; the function returns one
/// of them.
///
/// pre: R is a rotation. An error e of R gives an error O(e) of the vector.
/// The error is at most 4 eps |w|, for |w| from 1e-300 to π. A NaN or an
/// infinity gives NaN in all entries.
Eigen::Vector3d LogSo3(const Eigen::Matrix3d& R) noexcept;

/// Returns the rotation at fraction t of the shorter arc from R_0 (t = 0) to
/// R_1 (t = 1), at a constant angular velocity:
///     R_0 exp(t log(R_0' R_1)).
Eigen::Matrix3d InterpolateSo3(const Eigen::Matrix3d& R_0,
                               const Eigen::Matrix3d& R_1, double t) noexcept;

/// Returns the rotation nearest to A in the Frobenius norm. With A = U S V' it
/// is U diag(1, 1, det(U V')) V'.
///
/// pre: A is nearly a rotation. (The result is unique if A is not singular and,
/// for det A < 0, its two smallest singular values differ.) A NaN or an
/// infinity gives NaN in all entries. The iterative SVD takes about 2 us: not
/// for each tick.
///
/// Source: Kabsch, Acta Cryst. A34, 1978.
Eigen::Matrix3d ProjectToSo3(const Eigen::Matrix3d& A) noexcept;

}  // namespace poise
