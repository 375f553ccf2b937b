// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// A rectangle with sides along x and y, m.
struct Rectangle {
  Eigen::Vector2d center;
  Eigen::Vector2d half_size;
};

/// Returns the convex hull of points in the plane, counterclockwise. Points on
/// the edges of the hull are left out. If all points lie on a line, the result
/// has fewer than three points.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points);

/// Returns whether the points are the corners of a convex polygon, in clockwise
/// or counterclockwise order. Corners may also lie on an edge, up to 1e-3 rad.
bool IsConvex(const std::vector<Eigen::Vector2d>& corners);

/// Returns the largest rectangle with sides along x and y inside a convex
/// polygon. The error is at most 1e-9 of the polygon's size.
///
/// @pre The polygon is convex, counterclockwise, and has at least three
/// corners.
Rectangle LargestRectangle(const std::vector<Eigen::Vector2d>& polygon);

/// Makes a foot on a link from a sole polygon. The polygon is given in a frame
/// S that is fixed to the link, with z out of the ground and x forward. The
/// contact frame C has S's axes and lies at the center of the polygon's largest
/// rectangle. A polygon with more than 64 corners is reduced: only the extreme
/// corners in 64 directions remain.
///
/// Returns nothing if the rectangle is less than 1 mm wide or long.
std::optional<Foot> MakeFoot(const RobotModel& model, std::string name,
                             int frame, const Pose& X_FS,
                             const std::vector<Eigen::Vector2d>& sole_S);

}  // namespace poise
