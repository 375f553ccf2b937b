// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// A rectangle that is turned in the plane.
struct TurnedRectangle {
  Eigen::Vector2d center;     ///< m.
  Eigen::Vector2d half_size;  ///< Along its own x and y axes, m.
  double angle;               ///< From the plane's x axis to its own, rad.
};

/// Returns the smallest rectangle around a polygon. Its sides are the sole's
/// own length and width: a toed-out sole is smaller than its bounds along x and
/// y. The angle is at most pi/4, so the length is along the side nearest to x.
/// If the smallest area is above 90 % of the area of the bounds along x and y,
/// these bounds are returned.
///
/// The cost is O(n^2).
/// @pre The polygon is convex and has at least three corners.
TurnedRectangle SurroundingRectangle(
    const std::vector<Eigen::Vector2d>& polygon);

}  // namespace poise
