// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "poise/math/exact_dot.h"

namespace poise {

/// Stumpff holds the Stumpff functions c1, c2, c3 of s = θ²,
///     cm(s) = 1/m! - s/(m+2)! + s²/(m+4)! - ...,
///     c1 = sin θ / θ,   c2 = (1 - cos θ) / θ²,   c3 = (θ - sin θ) / θ³,
/// and their derivatives dcm = 2 d/ds cm = 1/θ d/dθ cm. Every map of SO(3) and
/// SE(3) in this folder is a combination of them.
struct Stumpff {
  double c1, c2, c3;
  double dc1, dc2, dc3;
};

/// kStumpffSwitch is the value of s = θ² below which series replace the closed
/// forms; θ = 1.58 rad.
///
/// Both must be accurate at the switch. Above, c3 is (1 - c1) / s and dc3 is
/// (c2 - 3 c3) / s: an error e of c1 becomes e/s and 3 e/s², so that s >= 1 is
/// needed. Below, c1 is 1 - s c3, which loses no digits for s c3 < 1/2, that is
/// s < 3.4. The quaternion of a rotation by at most π needs s up to (π/2)² =
/// 2.47. With the switch above this value it needs no sine.
constexpr double kStumpffSwitch = 2.5;

/// StumpffSeries computes c1 to c6 by their series, for 0 <= s <
/// kStumpffSwitch.
///
/// The series of c5 and c6 are summed; the others follow from
///     cm = 1/m! - s c(m+2).
/// The first omitted terms are at most 2e-17 times the sums.
struct StumpffSeries {
  explicit StumpffSeries(double s) noexcept;
  double c1, c2, c3, c4, c5, c6;
};

/// Computes the Stumpff functions of s = |w|².
///
/// Below the switch the series are used, and dcm = m c(m+2) - c(m+1). Above,
/// sine and cosine are used, and dcm = (c(m-1) - m cm) / s.
///
/// A NaN, an infinity or |w| > 1e154 gives NaN in all members. 40 flops below
/// the switch. The function is inline, so that unused members cost nothing.
///
/// Source: Stumpff, Himmelsmechanik I, 1959, ch. V.
inline Stumpff ComputeStumpff(const Eigen::Vector3d& w) noexcept {
  const double s = w.squaredNorm();
  if (s < kStumpffSwitch) {
    const StumpffSeries c(s);
    return {c.c1, c.c2, c.c3, c.c3 - c.c2, 2 * c.c4 - c.c3, 3 * c.c5 - c.c4};
  }
  const double angle = std::sqrt(s);
  Stumpff c;
  c.c1 = std::sin(angle) / angle;
  c.c2 = (1 - std::cos(angle)) / s;
  c.c3 = (1 - c.c1) / s;
  c.dc1 = c.c3 - c.c2;
  c.dc2 = (c.c1 - 2 * c.c2) / s;
  c.dc3 = (c.c2 - 3 * c.c3) / s;
  return c;
}

/// InverseStumpff holds the coefficients of the inverse Jacobians. With s = θ²,
///     e = θ/2 cot θ/2,   d = (1 - e) / s,
/// and their derivatives are de = 2 d/ds e and dd = 2 d/ds d.
struct InverseStumpff {
  double e, d, de, dd;
};

/// AccurateAngle computes the norm of w as near + rest, with an error of
/// 2^-100, and its square. The accuracy is needed because the sine near π and 2
/// π, and the cotangent, enlarge a relative error of the angle. |w| > 1e154
/// gives NaN.
struct AccurateAngle {
  explicit AccurateAngle(const Eigen::Vector3d& w) noexcept {
    const TwoDoubles s = ExactDot(w, w);
    square = s.near;
    near = std::sqrt(square);
    rest = (std::fma(-near, near, square) + s.rest) / (2 * near);
  }
  double near, rest, square;
};

/// Computes InverseStumpff of s = |w|².
///
/// Below the switch Stumpff's functions are used. With ' for 2 d/ds,
///     e = c1 / (2 c2),   d = -c2' / (2 c2).
/// Above, 1 - e is not small, and sine and cosine of θ/2 are used. The result
/// is singular if θ is a multiple of 2 π other than 0. A NaN, an infinity or
/// |w| > 1e154 gives NaN in all members.
inline InverseStumpff ComputeInverseStumpff(const Eigen::Vector3d& w) noexcept {
  InverseStumpff inverse;
  const double s = w.squaredNorm();
  if (s < kStumpffSwitch) {
    const StumpffSeries c(s);
    const double dc2 = 2 * c.c4 - c.c3;
    const double ddc2 = c.c4 - 5 * c.c5 + 8 * c.c6;
    inverse.e = 0.5 * c.c1 / c.c2;
    inverse.d = -0.5 * dc2 / c.c2;
    inverse.dd = 0.5 * (dc2 * dc2 / c.c2 - ddc2) / c.c2;
    inverse.de = -2 * inverse.d - s * inverse.dd;
  } else {
    const AccurateAngle angle(w);
    const double half = 0.5 * angle.near;
    const double sine = std::sin(half), cosine = std::cos(half);
    const double h = (sine + 0.5 * cosine * angle.rest) / half;
    inverse.e = (cosine - 0.5 * sine * angle.rest) / h;
    inverse.d = (1 - inverse.e) / angle.square;
    inverse.de = (inverse.e - 1 / (h * h)) / angle.square;
    inverse.dd = (-inverse.de - 2 * inverse.d) / angle.square;
  }
  return inverse;
}

inline StumpffSeries::StumpffSeries(double s) noexcept {
  c5 = 1 / 120.0 -
       s * (1 / 5040.0 -
            s * (1 / 362880.0 -
                 s * (1 / 39916800.0 -
                      s * (1 / 6227020800.0 -
                           s * (1 / 1307674368000.0 -
                                s * (1 / 355687428096000.0 -
                                     s * (1 / 121645100408832000.0 -
                                          s / 51090942171709440000.0)))))));
  c6 = 1 / 720.0 -
       s * (1 / 40320.0 -
            s * (1 / 3628800.0 -
                 s * (1 / 479001600.0 -
                      s * (1 / 87178291200.0 -
                           s * (1 / 20922789888000.0 -
                                s * (1 / 6402373705728000.0 -
                                     s * (1 / 2432902008176640000.0 -
                                          s / 1124000727777607680000.0)))))));
  c4 = 1 / 24.0 - s * c6;
  c3 = 1 / 6.0 - s * c5;
  c2 = 0.5 - s * c4;
  c1 = 1 - s * c3;
}

}  // namespace poise
