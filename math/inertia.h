// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/pose.h"
#include "poise/math/spatial.h"
#include "poise/math/vector6.h"

namespace poise {

/// Inertia is the inertia M_BBo_B of a rigid body, in the axes of a frame B
/// fixed in the body. It stores the center of mass G and the inertia about G,
/// not about Bo: so a Shift() of B leaves I_G exact and costs three
/// subtractions.
///
/// All functions allocate nothing and throw nothing; NaN and infinity
/// propagate.
struct Inertia {
  double mass = 0;                                    ///< kg.
  Eigen::Vector3d p_BoG_B = Eigen::Vector3d::Zero();  ///< Center of mass, m.
  Eigen::Matrix3d I_G_B = Eigen::Matrix3d::Zero();    ///< About G, kg m2.
};

/// Returns the same inertia, with origin Q instead of Bo and the same axes.
inline Inertia Shift(const Inertia& M_B,
                     const Eigen::Vector3d& p_BQ_B) noexcept {
  return {M_B.mass, M_B.p_BoG_B - p_BQ_B, M_B.I_G_B};
}

/// Returns the same inertia about the same point, in the axes of A:
///     I_G_A = R_AB I_G_B R_AB', symmetric to the bit.
Inertia operator*(const Eigen::Matrix3d& R_AB, const Inertia& M_B) noexcept;

/// Returns the same inertia about the origin and in the axes of A.
inline Inertia operator*(const Pose& X_AB, const Inertia& M_B) noexcept {
  return Shift(X_AB.R * M_B, -X_AB.p);
}

/// Returns the inertia of two bodies welded together, both in the same frame:
///     m = m_1 + m_2,   p = (m_1 p_1 + m_2 p_2) / m,
///     I_G = I_1 + I_2 + m_1 m_2 / m (r'r I - r r'),   r = p_2 - p_1.
/// If both masses are zero, the center of mass is that of M_1.
Inertia operator+(const Inertia& M_1, const Inertia& M_2) noexcept;

/// Returns the momentum about Bo of a body that moves with V_B (at Bo). With
/// p = p_BoG and v_G = v + w x p,
///     [I_G w + p x m v_G; m v_G].
SpatialMomentum operator*(const Inertia& M_B,
                          const SpatialMotion& V_B) noexcept;

/// Returns the force about Bo that accelerates a body at rest by A_B. For a
/// body that turns with w, Newton and Euler's equations are
///     F_B = M A + Cross(W, M W),   W = [w; 0].
/// The linear velocity of Bo has no effect on F_B.
SpatialForce operator*(const Inertia& M_B,
                       const SpatialAcceleration& A_B) noexcept;

/// Returns the kinetic energy in J of a body that moves with V_B (at Bo):
///     1/2 (m v_G'v_G + w' I_G w).
double KineticEnergy(const Inertia& M_B, const SpatialMotion& V_B) noexcept;

/// Returns the 6 x 6 matrix M of momentum = M V about Bo, symmetric to the bit:
///     M = [ I_G + m (p'p I - p p')   m Hat(p) ],   p = p_BoG_B.
///         [      -m Hat(p)            m I     ]
Matrix6d Matrix6FromInertia(const Inertia& M_B) noexcept;

/// Returns the principal moments of an inertia, ascending, in kg m2: the
/// eigenvalues of I_G, of which the lower triangle is read. Their error is some
/// eps times the largest entry. Moments that no body has, negative ones and
/// those beyond the sum of the other two, are returned as they are. If an entry
/// is NaN or infinite, all moments are NaN.
///
/// @param I_G  inertia about any point in any axes, symmetric, kg m2.
/// Costs about 0.7 us. Source: Golub and Van Loan, "Matrix computations", 1996,
/// 8.3, tridiagonal reduction and implicit QR steps, by Eigen.
Eigen::Vector3d PrincipalMoments(const Eigen::Matrix3d& I_G) noexcept;

/// InertiaDefect says why no body has a given inertia.
enum class InertiaDefect {
  kNone,
  kNotFinite,     ///< An entry is NaN or infinite.
  kMass,          ///< The mass is not positive.
  kNotSymmetric,  ///< I_G differs from its transpose.
  kNotPositive,   ///< A principal moment is negative.
  kTriangle,      ///< A principal moment exceeds the sum of the other two.
};

/// Checks that some distribution of positive mass has this inertia: mass > 0,
/// and I_G symmetric with principal moments 0 <= I_1, I_2, I_3 <= the sum of
/// the other two. A point and a thin rod pass. The tolerance for rounding
/// errors of a rotation is 16 eps times the largest entry of I_G.
///
/// Returns the first defect in the order of the enumeration.
[[nodiscard]] InertiaDefect FindDefect(const Inertia& M_B) noexcept;

}  // namespace poise
