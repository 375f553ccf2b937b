// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/math/inertia.h"

#include <Eigen/Eigenvalues>
#include <limits>

#include "poise/math/so3.h"

namespace poise {
namespace {

// Returns p'p I - p p', the inertia of a unit mass at p about the origin.
Eigen::Matrix3d PointInertia(const Eigen::Vector3d& p) {
  Eigen::Matrix3d I = -p * p.transpose();
  I.diagonal().array() += p.squaredNorm();
  return I;
}

// Returns the velocity of the center of mass.
Eigen::Vector3d CenterVelocity(const Inertia& M_B, const SpatialMotion& V_B) {
  return V_B.linear + V_B.angular.cross(M_B.p_BoG_B);
}

}  // namespace

Inertia operator*(const Eigen::Matrix3d& R_AB, const Inertia& M_B) noexcept {
  Inertia M_A{M_B.mass, R_AB * M_B.p_BoG_B,
              R_AB * M_B.I_G_B * R_AB.transpose()};
  M_A.I_G_B.triangularView<Eigen::StrictlyLower>() = M_A.I_G_B.transpose();
  return M_A;
}

Inertia operator+(const Inertia& M_1, const Inertia& M_2) noexcept {
  const double mass = M_1.mass + M_2.mass;
  const double fraction = mass == 0 ? 0 : M_2.mass / mass;
  const Eigen::Vector3d r = M_2.p_BoG_B - M_1.p_BoG_B;
  return {mass, M_1.p_BoG_B + fraction * r,
          M_1.I_G_B + M_2.I_G_B + M_1.mass * fraction * PointInertia(r)};
}

SpatialMomentum operator*(const Inertia& M_B,
                          const SpatialMotion& V_B) noexcept {
  const Eigen::Vector3d linear = M_B.mass * CenterVelocity(M_B, V_B);
  return {M_B.I_G_B * V_B.angular + M_B.p_BoG_B.cross(linear), linear};
}

SpatialForce operator*(const Inertia& M_B,
                       const SpatialAcceleration& A_B) noexcept {
  const Eigen::Vector3d a_G = A_B.linear + A_B.angular.cross(M_B.p_BoG_B);
  const Eigen::Vector3d force = M_B.mass * a_G;
  return {M_B.I_G_B * A_B.angular + M_B.p_BoG_B.cross(force), force};
}

double KineticEnergy(const Inertia& M_B, const SpatialMotion& V_B) noexcept {
  return 0.5 * (M_B.mass * CenterVelocity(M_B, V_B).squaredNorm() +
                V_B.angular.dot(M_B.I_G_B * V_B.angular));
}

Matrix6d Matrix6FromInertia(const Inertia& M_B) noexcept {
  const Eigen::Matrix3d m_p = M_B.mass * Hat(M_B.p_BoG_B);
  const Eigen::Matrix3d I_Bo = M_B.I_G_B + M_B.mass * PointInertia(M_B.p_BoG_B);
  Matrix6d M;
  M << 0.5 * (I_Bo + I_Bo.transpose()), m_p,  //
      m_p.transpose(), M_B.mass * Eigen::Matrix3d::Identity();
  return M;
}

Eigen::Vector3d PrincipalMoments(const Eigen::Matrix3d& I_G) noexcept {
  if (!I_G.allFinite()) {
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(I_G,
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues();
}

InertiaDefect FindDefect(const Inertia& M_B) noexcept {
  const Eigen::Matrix3d& I = M_B.I_G_B;
  if (!std::isfinite(M_B.mass) || !M_B.p_BoG_B.allFinite() || !I.allFinite()) {
    return InertiaDefect::kNotFinite;
  }
  if (M_B.mass <= 0) return InertiaDefect::kMass;
  const double tolerance =
      16 * std::numeric_limits<double>::epsilon() * I.cwiseAbs().maxCoeff();
  if ((I - I.transpose()).cwiseAbs().maxCoeff() > tolerance) {
    return InertiaDefect::kNotSymmetric;
  }
  const Eigen::Vector3d moments = PrincipalMoments(I);
  if (moments[0] < -tolerance) return InertiaDefect::kNotPositive;
  if (moments[2] > moments[0] + moments[1] + tolerance) {
    return InertiaDefect::kTriangle;
  }
  return InertiaDefect::kNone;
}

}  // namespace poise
