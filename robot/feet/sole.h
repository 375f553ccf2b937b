// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/robot.h"

namespace poise {

/// The points of a body that may touch the ground. They come from its collision
/// shapes, or from its visual shapes if those give no point. Meshes are not
/// opened.
struct Outline {
  /// A point of the body, or a ball about it.
  struct Corner {
    int frame;  ///< The link, an index into Tree::frames().
    Eigen::Vector3d p_B;
    double radius;  ///< m.
  };
  std::vector<Corner> corners;
  std::vector<Eigen::Vector3d> axes_B;  ///< Of the body and of its shapes.
};

/// Returns the outline of each body of a robot.
std::vector<Outline> MakeOutlines(const RobotModel& model);

/// A flat underside of a body.
struct Sole {
  int frame = 0;  ///< The link, an index into Tree::frames().
  Eigen::Vector3d normal_B = Eigen::Vector3d::Zero();  ///< Out of the ground.
  std::vector<Eigen::Vector3d> points_B;               ///< All in one plane.
  double area = 0;                                     ///< m².
};

/// Finds the largest flat underside of a body, among the planes that are normal
/// to one of its axes or to `up_B` and within 35 degrees of level. The result has
/// no points if there is no such plane.
Sole FindSole(const Outline& outline, const Eigen::Vector3d& up_B);

/// Estimates the sole of a foot without shapes, as FindFeet() describes.
///
/// @param p_BA_B  the position of the ankle.
/// @param leg  the length of the leg, m.
Sole EstimateSole(const RobotModel& model, int body,
                  const Eigen::Vector3d& up_B, const Eigen::Vector3d& forward_B,
                  const Eigen::Vector3d& p_BA_B, double leg);

/// Returns the frame S in the plane of a sole, below the body's origin. Its z
/// axis is the normal. Its x axis points forward, along an axis of the foot if
/// one is near.
Pose MakeSoleAxes(const Sole& sole, const Outline& outline,
                  const Eigen::Vector3d& forward_B);

}  // namespace poise
