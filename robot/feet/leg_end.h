// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/feet/sole.h"
#include "poise/robot/robot.h"

namespace poise {

/// Returns the coordinate [m] along `up_B` of the lowest point of each body.
/// The points are those of its outline, the origins of its links with shapes
/// (a mesh may give no points), and the joint that moves the body. A link
/// without shapes is ignored, because `world` and `base_footprint` are often
/// below the feet.
///
/// @param X_BB  the poses of the bodies relative to the root link.
std::vector<double> LowestPoints(const RobotModel& model,
                                 const std::vector<Outline>& outlines,
                                 const std::vector<Pose>& X_BB,
                                 const Eigen::Vector3d& up_B);

/// The body at the end of a leg.
struct LegEnd {
  int foot;
  std::vector<int> toes;  ///< Joints that move toes in front of the foot.
};

/// Finds the body at the end of a leg: the last moved one. Among several ends,
/// it is the heaviest one within 0.05 of the leg's length above the leg's
/// lowest point, because rods of an ankle drive are light. Bodies without mass
/// and shape are skipped.
///
/// Toes are left out: bodies whose joint is near the ground, parallel to an
/// ankle near the ground, and further in front of the ankle than below it.
///
/// @param hip     the first body of the leg.
/// @param low     see LowestPoints().
/// @param length  of the leg, m.
LegEnd FindLegEnd(const RobotModel& model, const std::vector<Pose>& X_BB,
                  const std::vector<double>& low, int hip,
                  const Eigen::Vector3d& up_B, double length);

}  // namespace poise
