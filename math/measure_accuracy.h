// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace poise {

/// Accuracy is the largest error of one map of SO(3) or SE(3) on one range of
/// angles.
struct Accuracy {
  std::string map;  ///< "ExpSo3", "ExpSe3, translation", ...
  double from, to;  ///< Angles, rad.
  double error;     ///< In eps = 2.2e-16, divided by the condition.
  double bar;       ///< Upper bound of error.
  double angle;     ///< Angle of the largest error, rad.
};

/// Measures the maps of math/so3.h, quaternion.h, so3_jacobian.h, se3.h and
/// se3_jacobian.h against power series in 400 bits:
///     exp(A) = sum A^n / n!,   J(A) = sum A^n / (n + 1)!,   A = ad(x),
/// and the inverse maps against the maps that they invert. Random angles are
/// logarithmic below 1 rad and uniform above, with more samples near the switch
/// of math/stumpff.h, π and 2 π. Random directions are uniform; a third have a
/// small or zero component. Linear velocities have norms from 1e-6 to 1e6; a
/// quarter are nearly normal and a quarter nearly parallel to the axis.
///
/// The error is |computed - exact| / |exact| in the Frobenius norm, divided by
/// the condition: the angle above π for exp, max(1, θ/|2 π - θ|) for inverse
/// Jacobians, else 1. "antisymmetric part" is (R - R')/2, relative to the
/// angle.
///
/// @param samples  number of samples for each range and map.
std::vector<Accuracy> MeasureAccuracy(int samples);

/// Writes the accuracy as a table in Markdown.
void WriteAccuracy(const std::vector<Accuracy>& accuracy, std::ostream& os);

}  // namespace poise
