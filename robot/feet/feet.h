// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "robot/robot.h"

namespace poise {

/// A rectangle with sides along x and y.
struct Rectangle {
  Eigen::Vector2d center;
  Eigen::Vector2d half_size;
};

/// The convex hull of points in the plane, counterclockwise, without points on
/// its edges. Fewer than three remain where the points lie on a line.
std::vector<Eigen::Vector2d> ConvexHull(std::vector<Eigen::Vector2d> points);

/// Whether corners, in their order and either way round, are those of a convex
/// polygon; they may lie on its edges, up to rounding.
bool IsConvex(const std::vector<Eigen::Vector2d>& corners);

/// The largest rectangle with sides along x and y inside a convex polygon,
/// given counterclockwise, to 1e-9 of the polygon's size.
///
/// @pre polygon is convex, with three corners or more.
Rectangle LargestRectangle(const std::vector<Eigen::Vector2d>& polygon);

/// A foot on a link, from a sole polygon in a frame S of the link with z out of
/// the ground and x forward: the contact frame C has S's axes and lies at the
/// center of the polygon's largest rectangle. Of a polygon with more than 64
/// corners, those that reach furthest in 64 directions remain.
///
/// Nothing where the rectangle is less than 1 mm wide or long.
std::optional<Foot> MakeFoot(const RobotModel& model, std::string name,
                             int frame, const Pose& X_FS,
                             const std::vector<Eigen::Vector2d>& sole_S);

}  // namespace poise
