// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/tools/drawing/canvas.h"

namespace poise {

/// The pose and zoom of the camera that takes a picture.
struct Camera {
  Eigen::Vector3d eye{3.0, -2.2, 1.35};   ///< World, m.
  Eigen::Vector3d target{0, 0.02, 0.68};  ///< Center of the picture, world, m.
  double height = 1.75;  ///< Visible height at the target's distance, m.
};

/// An arrow for a force that acts on a robot.
struct PushArrow {
  Eigen::Vector3d point;  ///< The point of application, world, m.
  Eigen::Vector3d force;  ///< World, N.
};

/// Draws a robot in the configuration q (see Tree), its shadow, and an arrow
/// for each push. The floor has a grid of 0.25 m.
void DrawRobot(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const RobotModel& robot, const Eigen::VectorXd& q,
               const std::vector<PushArrow>& pushes, const Camera& camera,
               Canvas* canvas);

/// Returns the camera with an increased height, so that the robot and the
/// arrows fit into a picture of the given size. The margin is 6 % of the size
/// on each side. If they already fit, returns the camera unchanged.
Camera FitCamera(const Eigen::Vector2d& size, const RobotModel& robot,
                 const Eigen::VectorXd& q, const std::vector<PushArrow>& pushes,
                 Camera camera);

}  // namespace poise
