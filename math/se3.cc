// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/se3.h"

#include <Eigen/Geometry>
#include <cmath>

#include "poise/math/exact_dot.h"
#include "poise/math/so3.h"
#include "poise/math/stumpff.h"

namespace poise {
namespace {

// TranslationBeyondHalfATurn() computes J_l(w) v for |w|² > 10, about half a
// turn and more. With k = w'v it splits v into parts parallel and normal to w:
//     p = k / θ² w + sin θ / θ (v - k / θ² w) + (1 - cos θ) / θ² w x v.
// Each term is accurate to its own last digit. The last two terms vanish near a
// full turn.
constexpr double kHalfTurn = 10;

Eigen::Vector3d TranslationBeyondHalfATurn(const Eigen::Vector3d& w,
                                           const Eigen::Vector3d& v) {
  const AccurateAngle angle(w);
  const double half = 0.5 * angle.near, rest = 0.5 * angle.rest;
  const double sine = std::sin(half) + std::cos(half) * rest;
  const double cosine = std::cos(half) - std::sin(half) * rest;
  const double c1 = sine * cosine / half;
  const double c2 = 2 * sine * sine / angle.square;
  const Eigen::Vector3d along = ExactDot(w, v).near / angle.square * w;
  return along + c1 * (v - along) + c2 * w.cross(v);
}

}  // namespace

Eigen::Matrix4d HatSe3(const Vector6d& x) noexcept {
  Eigen::Matrix4d W = Eigen::Matrix4d::Zero();
  W.topLeftCorner<3, 3>() = Hat(x.head<3>());
  W.topRightCorner<3, 1>() = x.tail<3>();
  return W;
}

Vector6d VeeSe3(const Eigen::Matrix4d& W) noexcept {
  Vector6d x;
  x << Vee(W.topLeftCorner<3, 3>()), W.topRightCorner<3, 1>();
  return x;
}

Pose ExpSe3(const Vector6d& x) noexcept {
  const Eigen::Vector3d w = x.head<3>(), v = x.tail<3>();
  Eigen::Vector3d p;
  if (w.squaredNorm() < kHalfTurn) {
    const Stumpff c = ComputeStumpff(w);
    // J_l(w) v = c1 v + c2 w x v + c3 w w' v.
    p = c.c1 * v + c.c2 * w.cross(v) + c.c3 * w.dot(v) * w;
  } else {
    p = TranslationBeyondHalfATurn(w, v);
  }
  // Adds zero, or NaN if an entry of v is not finite.
  return {ExpSo3(w), p.array() + 0 * v.sum()};
}

Vector6d LogSe3(const Pose& X) noexcept {
  const Eigen::Vector3d w = LogSo3(X.R);
  const InverseStumpff c = ComputeInverseStumpff(w);
  // J_l(w)^-1 p = e p - w x p / 2 + d w w' p.
  const Eigen::Vector3d v =
      c.e * X.p - 0.5 * w.cross(X.p) + c.d * w.dot(X.p) * w;
  Vector6d x;
  // Adds zero, or NaN if an entry of p is not finite.
  x << w, v.array() + 0 * X.p.sum();
  return x;
}

Matrix6d Adjoint(const Pose& X_AB) noexcept {
  Matrix6d Ad;
  Ad.topLeftCorner<3, 3>() = X_AB.R;
  Ad.topRightCorner<3, 3>().setZero();
  for (int i = 0; i < 3; ++i) {
    Ad.block<3, 1>(3, i) = X_AB.p.cross(X_AB.R.col(i));
  }
  Ad.bottomRightCorner<3, 3>() = X_AB.R;
  return Ad;
}

Matrix6d DualAdjoint(const Pose& X_AB) noexcept {
  Matrix6d Ad;
  Ad.topLeftCorner<3, 3>() = X_AB.R;
  for (int i = 0; i < 3; ++i) {
    Ad.block<3, 1>(0, 3 + i) = X_AB.p.cross(X_AB.R.col(i));
  }
  Ad.bottomLeftCorner<3, 3>().setZero();
  Ad.bottomRightCorner<3, 3>() = X_AB.R;
  return Ad;
}

Pose InterpolateSe3(const Pose& X_0, const Pose& X_1, double t) noexcept {
  return X_0 * ExpSe3(t * LogSe3(X_0.Inverse() * X_1));
}

}  // namespace poise
