// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/collision/capsule.h"
#include "poise/robot/robot.h"

namespace poise {

/// A ball inside a shape. A point of a surface, such as a vertex of a mesh, is
/// a ball of radius 0.
struct Ball {
  Eigen::Vector3d center;  ///< m.
  double radius = 0;       ///< m.
};

/// Returns balls whose convex hull contains a shape, in the frame in which X is
/// the shape's pose: a sphere itself, the corners of a box, two rings of points
/// around a cylinder. A mesh has no balls: its points come from its file.
std::vector<Ball> BallsOfShape(const Geometry& geometry, const Pose& X);

/// Returns a small capsule that contains balls, and so their convex hull. The
/// axis is parallel to a principal axis of the balls' centers or to the longest
/// distance from their mean; for each of these axes and some radii, the capsule
/// is the shortest one, and the one with the smallest volume is returned.
///
/// Throws std::invalid_argument if there is no ball or a number is not finite.
/// For setup: costs O(balls) times about a thousand operations.
Capsule FitCapsule(const std::vector<Ball>& balls);

/// Volume of a capsule, m3.
double Volume(const Capsule& capsule);

}  // namespace poise
