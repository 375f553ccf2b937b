// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/robot.h"

namespace poise {

/// The points of a body that may touch the ground. The points come from its
/// collision shapes, or from its visual shapes if the collision shapes give no
/// point. Meshes are not opened.
struct Outline {
  /// A point of the body, or a sphere around the point.
  struct Corner {
    int frame;  ///< The link, an index into Tree::frames().
    Eigen::Vector3d p_B;
    double radius;  ///< m.
  };
  std::vector<Corner> corners;
  /// The coordinate axes of the body and of its shapes, unit vectors.
  std::vector<Eigen::Vector3d> axes_B;
};

/// Returns the outline of each body of a robot.
std::vector<Outline> MakeOutlines(const RobotModel& model);

/// A flat underside of a body. B is the body's frame.
struct Sole {
  int frame = 0;  ///< The link, an index into Tree::frames().
  Eigen::Vector3d normal_B = Eigen::Vector3d::Zero();  ///< Out of the ground.
  std::vector<Eigen::Vector3d> points_B;               ///< All in one plane.
  double area = 0;                                     ///< m².
};

/// Finds the largest flat underside of a body. The candidate planes are normal
/// to one of the outline's axes or to `up_B`, and at most 35 degrees from
/// horizontal. The result has no points if no such plane has an area.
Sole FindSole(const Outline& outline, const Eigen::Vector3d& up_B);

/// Estimates the sole of a foot that has only meshes, as FindFeet() describes.
///
/// @param p_BA_B  the position of the ankle in the body, m.
/// @param leg     the length of the leg, m.
Sole EstimateSole(const RobotModel& model, int body,
                  const Eigen::Vector3d& up_B, const Eigen::Vector3d& forward_B,
                  const Eigen::Vector3d& p_BA_B, double leg);

/// Returns the pose of the sole frame S in the body. Its origin is the
/// projection of the body's origin onto the plane of the sole. Its z axis is
/// the normal. Its x axis points forward, along an axis of the outline if one
/// is within 0.3 rad.
Pose MakeSoleAxes(const Sole& sole, const Outline& outline,
                  const Eigen::Vector3d& forward_B);

}  // namespace poise
