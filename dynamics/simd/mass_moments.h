// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/body_arrays.h"
#include "poise/dynamics/simd/lanes.h"
#include "poise/math/inertia.h"

namespace poise {

/// MakeMassMoments() returns the moments about the body's origin, in its axes:
///     h = m p,   Sigma = trace(I_G) / 2 1 - I_G + m p p',   p = p_BoG_B.
inline MassMoments MakeMassMoments(const Inertia& M_B) {
  const Eigen::Vector3d h = M_B.mass * M_B.p_BoG_B;
  const Eigen::Matrix3d Sigma =
      0.5 * M_B.I_G_B.trace() * Eigen::Matrix3d::Identity() - M_B.I_G_B +
      h * M_B.p_BoG_B.transpose();
  return {M_B.mass,
          ToVec3(h),
          {Sigma(0, 0), Sigma(1, 1), Sigma(2, 2),  //
           Sigma(0, 1), Sigma(0, 2), Sigma(1, 2)}};
}

/// Rotate() returns the moments in the axes of A, from those in the axes of B:
///     h_A = R_AB h_B,   Sigma_A = R_AB Sigma_B R_AB'.
inline MassMoments Rotate(const Mat3& R_AB, const MassMoments& M) noexcept {
  return {M.mass, R_AB * M.h, Rotate(R_AB, M.Sigma)};
}

/// Shift() returns the moments about P, from those about B. With d = p_PB and x
/// replaced by d + x,
///     h_P = h + m d,   Sigma_P = Sigma + d h_P' + h d'.
inline MassMoments Shift(const Vec3& p_PB, const MassMoments& M) noexcept {
  const Vec3& d = p_PB;
  const Vec3& h = M.h;
  const Vec3 k = h + M.mass * d;
  const Sym3& S = M.Sigma;
  return {M.mass,
          k,
          {S.xx + d.x * k.x + h.x * d.x, S.yy + d.y * k.y + h.y * d.y,
           S.zz + d.z * k.z + h.z * d.z, S.xy + d.x * k.y + h.x * d.y,
           S.xz + d.x * k.z + h.x * d.z, S.yz + d.y * k.z + h.y * d.z}};
}

inline MassMoments operator+(const MassMoments& M, const MassMoments& N) {
  return {M.mass + N.mass, M.h + N.h, M.Sigma + N.Sigma};
}
/// AccelerationGradient() returns A = [alpha]x + [w]x [w]x. The point of a body
/// at x from its origin has the classical acceleration a + A x.
inline Mat3 AccelerationGradient(const Vec3& alpha, const Vec3& w) noexcept {
  const double xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const double xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return {{-(yy + zz), xy - alpha.z, xz + alpha.y},
          {xy + alpha.z, -(xx + zz), yz - alpha.x},
          {xz - alpha.y, yz + alpha.x, -(xx + yy)}};
}

/// Accelerate() returns the force about O that accelerates a body by a + A x:
///     n = sum of x x (a + A x) dm = h x a + vee(P - P'),   P = A Sigma,
///     f = sum of (a + A x) dm     = m a + A h,
/// where vee(P - P') = [P_zy - P_yz; P_xz - P_zx; P_yx - P_xy].
inline Force3 Accelerate(const MassMoments& M, const Mat3& A,
                         const Vec3& a) noexcept {
  const Mat3 P = A * Full(M.Sigma);  // Sum of (A x) x' dm.
  return {Cross(M.h, a) + Vec3{P.z.y - P.y.z, P.x.z - P.z.x, P.y.x - P.x.y},
          M.mass * a + A * M.h};
}

/// Momentum() returns the momentum about O of a body that turns with w about O
/// and moves with v:
///     [I w + h x v; m v - h x w],   I w = trace(Sigma) w - Sigma w.
inline Force3 Momentum(const MassMoments& M, const Vec3& w,
                       const Vec3& v) noexcept {
  const double trace = M.Sigma.xx + M.Sigma.yy + M.Sigma.zz;
  return {trace * w - M.Sigma * w + Cross(M.h, v), M.mass * v - Cross(M.h, w)};
}

}  // namespace poise
