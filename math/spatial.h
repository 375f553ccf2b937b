// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Geometry>
#include <type_traits>

#include "poise/math/pose.h"
#include "poise/math/vector6.h"

namespace poise {

/// SpatialKind is the kind of a spatial vector.
enum class SpatialKind { kMotion, kAcceleration, kForce, kMomentum };

/// SpatialVector is a spatial vector at a point and in the axes of a frame. The
/// name of a variable says both: V_WB_E is the motion of B in W, at B's origin,
/// in E's axes. The compiler adds only vectors of the same kind; the caller
/// must add only vectors at the same point and in the same axes.
///
/// | kind | angular | linear | name |
/// | motion | velocity w, rad/s | velocity of the point, m/s | V_WB_E |
/// | acceleration | rate of w, rad/s2 | rate of the point's v, m/s2 | A_WB_E |
/// | force | moment about the point, N m | force, N | F_Bo_E |
/// | momentum | about the point, kg m2/s | kg m/s | L_G_E |
///
/// Accelerations are classical: the linear part is the rate of the point's
/// velocity. A shift to another point depends on the angular velocity. (The
/// spatial acceleration of Featherstone is the classical one less [0; w x v].)
/// No function allocates or throws. NaN and infinity propagate.
template <SpatialKind kind>
struct SpatialVector {
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();

  SpatialVector() = default;
  SpatialVector(const Eigen::Vector3d& angular_part,
                const Eigen::Vector3d& linear_part) noexcept
      : angular(angular_part), linear(linear_part) {}
  /// Converts [angular; linear]; the caller chooses the kind.
  explicit SpatialVector(const Vector6d& x) noexcept
      : angular(x.head<3>()), linear(x.tail<3>()) {}

  /// Returns [angular; linear].
  Vector6d vector() const noexcept {
    return (Vector6d() << angular, linear).finished();
  }
};

using SpatialMotion = SpatialVector<SpatialKind::kMotion>;
using SpatialAcceleration = SpatialVector<SpatialKind::kAcceleration>;
using SpatialForce = SpatialVector<SpatialKind::kForce>;
using SpatialMomentum = SpatialVector<SpatialKind::kMomentum>;

template <SpatialKind kind>
SpatialVector<kind> operator+(const SpatialVector<kind>& x,
                              const SpatialVector<kind>& y) noexcept {
  return {x.angular + y.angular, x.linear + y.linear};
}

template <SpatialKind kind>
SpatialVector<kind> operator-(const SpatialVector<kind>& x,
                              const SpatialVector<kind>& y) noexcept {
  return {x.angular - y.angular, x.linear - y.linear};
}

template <SpatialKind kind>
SpatialVector<kind> operator-(const SpatialVector<kind>& x) noexcept {
  return {-x.angular, -x.linear};
}

template <SpatialKind kind>
SpatialVector<kind> operator*(double factor,
                              const SpatialVector<kind>& x) noexcept {
  return {factor * x.angular, factor * x.linear};
}

/// Returns the same vector at the same point, in the axes of A: R_AB x_B.
template <SpatialKind kind>
SpatialVector<kind> operator*(const Eigen::Matrix3d& R_AB,
                              const SpatialVector<kind>& x_B) noexcept {
  return {R_AB * x_B.angular, R_AB * x_B.linear};
}

/// Returns the same vector at another point Q, in the same axes. p_BQ_E is the
/// position of Q from the vector's point Bo:
///     v_Q = v_B + w x p_BQ    of a motion,
///     m_Q = m_B - p_BQ x f    of a force or momentum.
template <SpatialKind kind,
          typename = std::enable_if_t<kind != SpatialKind::kAcceleration>>
SpatialVector<kind> Shift(const SpatialVector<kind>& x_Bo_E,
                          const Eigen::Vector3d& p_BQ_E) noexcept {
  if constexpr (kind == SpatialKind::kMotion) {
    return {x_Bo_E.angular, x_Bo_E.linear + x_Bo_E.angular.cross(p_BQ_E)};
  } else {
    return {x_Bo_E.angular - p_BQ_E.cross(x_Bo_E.linear), x_Bo_E.linear};
  }
}

/// Returns the acceleration of another point Q of a body that moves with V_B:
///     a_Q = a_B + alpha x p_BQ + w x (w x p_BQ).
inline SpatialAcceleration Shift(const SpatialAcceleration& A_Bo_E,
                                 const SpatialMotion& V_Bo_E,
                                 const Eigen::Vector3d& p_BQ_E) noexcept {
  const Eigen::Vector3d& w = V_Bo_E.angular;
  return {A_Bo_E.angular, A_Bo_E.linear + A_Bo_E.angular.cross(p_BQ_E) +
                              w.cross(w.cross(p_BQ_E))};
}

/// Returns the same vector at the origin and in the axes of A, from those of B.
/// The matrix is Adjoint(X_AB) for motions, DualAdjoint(X_AB) for forces and
/// momenta.
template <SpatialKind kind,
          typename = std::enable_if_t<kind != SpatialKind::kAcceleration>>
SpatialVector<kind> operator*(const Pose& X_AB,
                              const SpatialVector<kind>& x_Bo_B) noexcept {
  // p_BA_A = -p_AB_A.
  return Shift(X_AB.R * x_Bo_B, -X_AB.p);
}

/// Returns the power in W of a force along a motion at the same point and in
/// the same axes.
inline double Dot(const SpatialMotion& V_B, const SpatialForce& F_B) noexcept {
  return V_B.angular.dot(F_B.angular) + V_B.linear.dot(F_B.linear);
}

/// Returns V'L in J, with both at the same point and in the same axes. If L is
/// the momentum of a rigid body that moves with V, it is twice the kinetic
/// energy.
inline double Dot(const SpatialMotion& V_B,
                  const SpatialMomentum& L_B) noexcept {
  return V_B.angular.dot(L_B.angular) + V_B.linear.dot(L_B.linear);
}

/// Returns the rate ad(V) y of a motion y that is fixed in a body with velocity
/// V:
///     [w x y.angular; w x y.linear + v x y.angular].
inline SpatialMotion Cross(const SpatialMotion& V,
                           const SpatialMotion& y) noexcept {
  return {V.angular.cross(y.angular),
          V.angular.cross(y.linear) + V.linear.cross(y.angular)};
}

/// Returns the rate -ad(V)' y of a force y that is fixed in a body with
/// velocity V:
///     [w x y.angular + v x y.linear; w x y.linear].
inline SpatialForce Cross(const SpatialMotion& V,
                          const SpatialForce& y) noexcept {
  return {V.angular.cross(y.angular) + V.linear.cross(y.linear),
          V.angular.cross(y.linear)};
}

/// Returns the rate of a momentum y that is fixed in a body with velocity V.
/// The rate is a force, and has the same formula as the rate of a force.
inline SpatialForce Cross(const SpatialMotion& V,
                          const SpatialMomentum& y) noexcept {
  return Cross(V, SpatialForce(y.angular, y.linear));
}

/// Returns the matrix ad(V) of y -> Cross(V, y) for motions y:
///     [ Hat(w)    0    ]
///     [ Hat(v)  Hat(w) ].
/// The matrix for forces and momenta is -CrossMatrix(V)'.
Matrix6d CrossMatrix(const SpatialMotion& V) noexcept;

}  // namespace poise
