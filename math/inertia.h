// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/pose.h"
#include "poise/math/spatial.h"
#include "poise/math/vector6.h"

namespace poise {

/// The inertia of a rigid body, in the axes of a frame B fixed in it: M_BBo_B.
/// As the center of mass and the inertia about it are kept, not the inertia
/// about Bo, a change of B is exact in I_G and costs nothing for a Shift().
///
/// All functions allocate nothing and throw nothing; NaN and infinity
/// propagate.
struct Inertia {
  double mass = 0;                                    ///< kg.
  Eigen::Vector3d p_BoG_B = Eigen::Vector3d::Zero();  ///< Center of mass, m.
  Eigen::Matrix3d I_G_B = Eigen::Matrix3d::Zero();    ///< About G, kg m2.
};

/// The same inertia, about another point Q and the same axes.
inline Inertia Shift(const Inertia& M_B,
                     const Eigen::Vector3d& p_BQ_B) noexcept {
  return {M_B.mass, M_B.p_BoG_B - p_BQ_B, M_B.I_G_B};
}

/// The same inertia about the same point, in the axes of A:
///     I_G_A = R_AB I_G_B R_AB', symmetric to the bit.
Inertia operator*(const Eigen::Matrix3d& R_AB, const Inertia& M_B) noexcept;

/// The same inertia about the origin and in the axes of A.
inline Inertia operator*(const Pose& X_AB, const Inertia& M_B) noexcept {
  return Shift(X_AB.R * M_B, -X_AB.p);
}

/// The inertia of two bodies, welded; both of one frame:
///     m = m_1 + m_2,   p = (m_1 p_1 + m_2 p_2) / m,
///     I_G = I_1 + I_2 + m_1 m_2 / m (r'r I - r r'),   r = p_2 - p_1.
/// Of two without mass, the center of mass is that of the first.
Inertia operator+(const Inertia& M_1, const Inertia& M_2) noexcept;

/// The momentum, about Bo, of a body that moves with V_B (at Bo): with p =
/// p_BoG and v_G = v + w x p,
///     [I_G w + p x m v_G; m v_G].
SpatialMomentum operator*(const Inertia& M_B,
                          const SpatialMotion& V_B) noexcept;

/// The force, about Bo, that accelerates a body at rest by A_B. One that turns
/// takes more, and by Newton and Euler
///     F_B = M A + Cross(W, M W),   W = [w; 0]:
/// the linear velocity of Bo takes none.
SpatialForce operator*(const Inertia& M_B,
                       const SpatialAcceleration& A_B) noexcept;

/// The kinetic energy of a body that moves with V_B (at Bo), J:
///     1/2 (m v_G'v_G + w' I_G w).
double KineticEnergy(const Inertia& M_B, const SpatialMotion& V_B) noexcept;

/// The matrix of the above about Bo, symmetric to the bit: momentum = M V,
///     M = [ I_G + m (p'p I - p p')   m Hat(p) ],   p = p_BoG_B.
///         [      -m Hat(p)            m I     ]
Matrix6d Matrix6FromInertia(const Inertia& M_B) noexcept;

/// Why an inertia cannot be that of a body, if it cannot.
enum class InertiaDefect {
  kNone,
  kNotFinite,     ///< A NaN or an infinity.
  kMass,          ///< The mass is not positive.
  kNotSymmetric,  ///< I_G differs from its transpose.
  kNotPositive,   ///< A principal moment is negative.
  kTriangle,      ///< A principal moment exceeds the sum of the other two.
};

/// Checks that some distribution of positive mass has this inertia: mass > 0,
/// and I_G symmetric with principal moments 0 <= I_1, I_2, I_3 <= the sum of
/// the other two. A point and a thin rod, the limits of that, pass. Tolerance:
/// 16 eps of the largest entry of I_G, as rounding leaves from a rotation.
///
/// The first defect found, in the order of the enumeration.
[[nodiscard]] InertiaDefect FindDefect(const Inertia& M_B) noexcept;

}  // namespace poise
