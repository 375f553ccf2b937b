// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace poise {

/// The largest error of one map of SO(3) or SE(3), met on one range of angles.
struct Accuracy {
  std::string map;  ///< "ExpSo3", "ExpSe3, translation", ...
  double from, to;  ///< Angles, rad.
  double error;     ///< In eps = 2.2e-16, over the condition of the map.
  double bar;       ///< What error must not exceed.
  double angle;     ///< Where error was met, rad.
};

/// Measures the maps of math/so3.h, quaternion.h, so3_jacobian.h, se3.h and
/// se3_jacobian.h against power series in 400 bits:
///     exp(A) = sum A^n / n!,   J(A) = sum A^n / (n + 1)!,   A = ad(x),
/// and their inverses against what they invert. Angles are drawn on a log grid
/// below 1 and evenly above, and thickly around the switch of math/stumpff.h,
/// π and 2 π; directions evenly, a third with a small or zero component. Linear
/// velocities are 1e-6 to 1e6 long, a quarter nearly across and a quarter nearly
/// along the axis.
///
/// Error: |computed - exact| / |exact| in the Frobenius norm, divided by the
/// condition: the angle above π for exp, max(1, θ/|2 π - θ|) for inverse
/// Jacobians, else 1. "antisymmetric part" is (R - R')/2, compared with the
/// angle.
///
/// @param samples  drawn of each range and map.
std::vector<Accuracy> MeasureAccuracy(int samples);

/// Writes it as a table in Markdown.
void WriteAccuracy(const std::vector<Accuracy>& accuracy, std::ostream& os);

}  // namespace poise
