// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// A rectangle with sides along x and y.
struct Rectangle {
  Eigen::Vector2d center;
  Eigen::Vector2d half_size;
};

/// Returns the convex hull of points in the plane, counterclockwise, without
/// points on its edges. If all points lie on a line, fewer than three remain.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points);

/// Returns whether corners, in either direction, are the corners of a convex
/// polygon. Corners may lie on its edges, up to rounding.
bool IsConvex(const std::vector<Eigen::Vector2d>& corners);

/// Returns the largest rectangle with sides along x and y inside a convex
/// polygon, to 1e-9 of the polygon's size.
///
/// @pre The polygon is convex, counterclockwise, with three corners or more.
Rectangle LargestRectangle(const std::vector<Eigen::Vector2d>& polygon);

/// Returns a foot on a link, made from a sole polygon. The polygon is given in a
/// frame S of the link with z out of the ground and x forward. The contact frame
/// C has S's axes and lies at the center of the polygon's largest rectangle. If
/// a polygon has more than 64 corners, the corners that reach furthest in 64
/// directions remain.
///
/// Returns nothing if the rectangle is less than 1 mm wide or long.
std::optional<Foot> MakeFoot(const RobotModel& model, std::string name,
                             int frame, const Pose& X_FS,
                             const std::vector<Eigen::Vector2d>& sole_S);

}  // namespace poise
