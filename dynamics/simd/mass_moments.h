// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/simd/lanes.h"
#include "poise/math/inertia.h"

namespace poise {

/// The moments of a body's mass about a point O: sums over its elements dm at x
/// from O. They rotate and shift as x does, and add up where points and axes
/// agree. The moment of inertia is I = trace(Sigma) 1 - Sigma.
///
/// Why not I itself: a field of accelerations a + A x, A = [alpha]x + [w]x
/// [w]x, acts on Sigma at once, without a gyroscopic term; the shift is
/// shorter, too.
struct MassMoments {
  double mass;  ///< Sum of dm, kg.
  Vec3 h;       ///< Of x dm, kg m.
  Sym3 Sigma;   ///< Of x x' dm, kg m2.
};

/// The moments about the body's origin, in its axes.
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

/// Moments in the axes of B, seen in those of A.
inline MassMoments Rotate(const Mat3& R_AB, const MassMoments& M) noexcept {
  return {M.mass, R_AB * M.h, Rotate(R_AB, M.Sigma)};
}

/// Moments about B, taken about P: x becomes p_PB + x.
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
/// [alpha]x + [w]x [w]x: a body's points at x from its origin accelerate by A x
/// more than it does.
inline Mat3 AccelerationGradient(const Vec3& alpha, const Vec3& w) noexcept {
  const double xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const double xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return {{-(yy + zz), xy - alpha.z, xz + alpha.y},
          {xy + alpha.z, -(xx + zz), yz - alpha.x},
          {xz - alpha.y, yz + alpha.x, -(xx + yy)}};
}

/// The force about O that the field of accelerations a + A x takes: the sums
/// of x cross (a + A x) dm and of (a + A x) dm.
inline Force3 Accelerate(const MassMoments& M, const Mat3& A,
                         const Vec3& a) noexcept {
  const Mat3 P = A * Full(M.Sigma);  // Sum of (A x) x' dm.
  return {Cross(M.h, a) + Vec3{P.z.y - P.y.z, P.x.z - P.z.x, P.y.x - P.x.y},
          M.mass * a + A * M.h};
}

/// The momentum about O of a rotation w about O and a translation v: I w +
/// h cross v, mass v - h cross w.
inline Force3 Momentum(const MassMoments& M, const Vec3& w,
                       const Vec3& v) noexcept {
  const double trace = M.Sigma.xx + M.Sigma.yy + M.Sigma.zz;
  return {trace * w - M.Sigma * w + Cross(M.h, v), M.mass * v - Cross(M.h, w)};
}

/// Many MassMoments, component by component.
class MassMomentsArray {
 public:
  explicit MassMomentsArray(int size = 0)
      : mass_(size), h_(size), Sigma_(size) {}
  MassMoments operator[](int i) const noexcept {
    return {mass_[i], h_[i], Sigma_[i]};
  }
  void Set(int i, const MassMoments& M) noexcept {
    mass_[i] = M.mass;
    h_.Set(i, M.h);
    Sigma_.Set(i, M.Sigma);
  }

 private:
  std::vector<double> mass_;
  Vec3Array h_;
  Sym3Array Sigma_;
};

}  // namespace poise
