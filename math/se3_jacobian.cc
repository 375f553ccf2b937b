// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/se3_jacobian.h"

#include "poise/math/so3.h"
#include "poise/math/stumpff.h"

namespace poise {
namespace {

// Coefficients holds the coefficients of a function a I + b Hat(w) + c w w' of
// Hat(w), and of its derivative: a', b', c'.
struct Coefficients {
  double a, b, c;
  double da, db, dc;
};

// Returns the same function of ad([w; v]), by blocks.
Matrix6d FunctionOfAd(const Coefficients& f, const Vector6d& x) {
  const Eigen::Vector3d w = x.head<3>(), v = x.tail<3>();
  const double k = w.dot(v);
  Eigen::Matrix3d J = f.c * w * w.transpose() + f.b * Hat(w);
  J.diagonal().array() += f.a;
  // Q has the terms u w' + w u' with u = c v + c' k w / 2.
  Eigen::Vector3d u = f.c * v + 0.5 * f.dc * k * w;
  // Adds zero, or NaN if an entry of v is not finite.
  u.array() += 0 * v.sum();
  Eigen::Matrix3d Q =
      u * w.transpose() + w * u.transpose() + Hat(f.b * v + f.db * k * w);
  Q.diagonal().array() += f.da * k;
  Matrix6d F;
  F << J, Eigen::Matrix3d::Zero(), Q, J;
  return F;
}

}  // namespace

Matrix6d LeftJacobianSe3(const Vector6d& x) noexcept {
  const Stumpff c = ComputeStumpff(x.head<3>());
  return FunctionOfAd({c.c1, c.c2, c.c3, c.dc1, c.dc2, c.dc3}, x);
}

Matrix6d RightJacobianSe3(const Vector6d& x) noexcept {
  return LeftJacobianSe3(-x);
}

Matrix6d InverseLeftJacobianSe3(const Vector6d& x) noexcept {
  const InverseStumpff c = ComputeInverseStumpff(x.head<3>());
  return FunctionOfAd({c.e, -0.5, c.d, c.de, 0, c.dd}, x);
}

Matrix6d InverseRightJacobianSe3(const Vector6d& x) noexcept {
  return InverseLeftJacobianSe3(-x);
}

}  // namespace poise
