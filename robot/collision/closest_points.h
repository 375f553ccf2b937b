// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/collision/capsule.h"

namespace poise {

/// The closest points of the segments of two capsules A and B, and the distance
/// between the surfaces.
struct ClosestPoints {
  Eigen::Vector3d p_A;  ///< Point on the segment of A, m.
  Eigen::Vector3d p_B;  ///< Point on the segment of B, m.
  double distance = 0;  ///< Between the surfaces, m; negative if they overlap.
  /// Gradient of the distance by p_A, and minus the gradient by p_B. Without
  /// softness it is the unit vector from p_B to p_A. Zero where the segments
  /// cross.
  Eigen::Vector3d gradient;
};

/// Computes the closest points of two capsules, given in the same frame:
///     D² = min over s, t in [0, 1] of
///          |x|² - softness (a s (1 - s) + e t (1 - t)),   x = p_A(s) - p_B(t),
/// a and e the squared lengths of the segments; the distance is D less both
/// radii. The minimum is found in closed form, by clamping s, then t, then s
/// (Ericson, Real-Time Collision Detection, 2005, section 5.1.9).
///
/// With softness 0 the distance is exact. It has a kink where segments become
/// parallel, because the closest points jump from end to end. With a softness
/// above 0 the function of s and t is strictly convex, so that the points move
/// continuously and the distance is continuously differentiable. D² is then at
/// most softness (a + e) / 4 smaller than with softness 0.
///
/// @param softness  0 to 1; control uses 0.01.
/// Does not allocate, does not throw.
ClosestPoints ComputeClosestPoints(const Capsule& A, const Capsule& B,
                                   double softness) noexcept;

}  // namespace poise
