// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "poise/math/exact_dot.h"

namespace poise {

/// The Stumpff functions c1, c2, c3 of s = θ²,
///     cm(s) = 1/m! - s/(m+2)! + s²/(m+4)! - ...,
/// of which every map of SO(3) and SE(3) in this folder is made:
///     c1 = sin θ / θ,   c2 = (1 - cos θ) / θ²,   c3 = (θ - sin θ) / θ³,
/// and their derivatives dcm = 2 d/ds cm = 1/θ d/dθ cm.
struct Stumpff {
  double c1, c2, c3;
  double dc1, dc2, dc3;
};

/// Where the ways to compute them change, of s = θ²; θ = 1.58.
///
/// Both ways must be good there. Above, c3 is (1 - c1) / s and dc3 (c2 - 3 c3)
/// / s: an error e of c1 becomes e/s and 3 e/s², so s must not be below 1.
/// Below, c1 is 1 - s c3, which loses nothing while s c3 < 1/2, that is s <
/// 3.4. In between lies (π/2)² = 2.47, up to which the quaternion of a rotation
/// by at most π asks for: it never needs a sine.
constexpr double kStumpffSwitch = 2.5;

/// c1 to c6 by their series, for 0 <= s < kStumpffSwitch.
///
/// The series of c5 and c6 are summed, the others follow from cm = 1/m! - s
/// c(m+2). The first terms left out are at most 2e-17 of the sums.
struct StumpffSeries {
  explicit StumpffSeries(double s) noexcept;
  double c1, c2, c3, c4, c5, c6;
};

/// Computes the Stumpff functions of s = |w|².
///
/// Below the switch by their series, and by the rule dcm = m c(m+2) - c(m+1);
/// above, from sine and cosine, and by the rule dcm = (c(m-1) - m cm) / s.
///
/// A NaN, an infinity or |w| > 1e154 gives NaN in all. 40 flops below the
/// switch. Inline, so that members which are not used cost nothing.
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

/// What the inverse Jacobians are made of: of s = θ²,
///     e = θ/2 cot θ/2,   d = (1 - e) / s,
/// and their derivatives de = 2 d/ds e and dd = 2 d/ds d.
struct InverseStumpff {
  double e, d, de, dd;
};

/// The norm of w, as near + rest, and its square: right to 2^-100, since the
/// sine near π and 2 π, and the cotangent, enlarge what is relative in the angle.
/// NaN where |w| > 1e154.
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
/// Below the switch from Stumpff's functions, since e = c1 / (2 c2) and d = -c2' /
/// (2 c2) with ' for 2 d/ds; above, where 1 - e is no longer small, from sine
/// and cosine of θ/2. Singular where θ is a multiple of 2 π other than 0. A
/// NaN, an infinity or |w| > 1e154 gives NaN in all.
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
