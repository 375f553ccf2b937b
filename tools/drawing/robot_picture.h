// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/tools/drawing/canvas.h"

namespace poise {

/// From where a picture is taken.
struct Camera {
  Eigen::Vector3d eye{3.0, -2.2, 1.35};   ///< World, m.
  Eigen::Vector3d target{0, 0.02, 0.68};  ///< What is in the middle.
  double height = 1.75;  ///< Of what is seen at the target's distance, m.
};

/// An arrow that ends on a robot.
struct PushArrow {
  Eigen::Vector3d point;  ///< Where it acts, world, m.
  Eigen::Vector3d force;  ///< N.
};

/// Draws a robot in a configuration q (see Tree), standing on a floor with a
/// grid of 0.25 m, with its shadow, and an arrow for each push.
void DrawRobot(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
               const RobotModel& robot, const Eigen::VectorXd& q,
               const std::vector<PushArrow>& pushes, const Camera& camera,
               Canvas* canvas);

/// The camera drawn back until that robot, and the arrows, fit into a picture of
/// that size with a margin; as it was if they do.
Camera FitCamera(const Eigen::Vector2d& size, const RobotModel& robot,
                 const Eigen::VectorXd& q, const std::vector<PushArrow>& pushes,
                 Camera camera);

}  // namespace poise
