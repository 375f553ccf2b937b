// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// A foot to stand on, and the height of the sole of the other foot.
struct SingleSupport {
  int foot;           ///< Index into Robot::feet.
  double lift;        ///< Height of the other sole above the ground, m.
  Eigen::Vector2d G;  ///< Target of the center of mass in the sole's frame, m.
  /// If true, the other sole keeps its pose too, raised by lift.
  bool keeps_other = false;
  /// Target of the center of mass above the ground, m. Not set: any height.
  std::optional<double> height = std::nullopt;
  /// Wanted lean of the base to the left, away from its orientation in
  /// robot.q_nominal: an angle about the -x axis of the foot's sole, rad.
  double lean = 0;
};

/// The goal of an inverse-kinematics search.
struct PostureGoal {
  /// Straight knees are bent to this angle, rad. Positive: knees forward.
  double knee_bend = 0;
  /// The joint angles to stay near to. Empty: those of robot.q_nominal.
  Eigen::VectorXd joints;
  /// The joint angles to start from. Empty: `joints`, with bent knees.
  Eigen::VectorXd start;
  /// Joints that keep their angle. Empty: none.
  std::vector<bool> fixed;
  /// If true, each sole points along +x and is at x = 0. If false, only the
  /// means over both soles are required.
  bool are_soles_parallel = true;
  /// If true, the base's axis that is nearest to vertical is upright when the
  /// robot stands. If false, a base that leans at rest by more than 0.35 rad
  /// keeps its lean.
  bool is_base_upright = false;
  /// If set, the robot stands on one foot. The start is robot.q_nominal, and
  /// the foot stays where it is.
  std::optional<SingleSupport> support;
};

/// The result of a search.
struct Posture {
  Eigen::VectorXd q;
  std::string lack;  ///< The largest error in words; empty if there is none.
  double error = 0;  ///< Sum of the errors of soles and center of mass, m, rad.
  bool are_soles_flat = false;  ///< At most the center of mass has an error.
  /// Joints at a limit, if there is an error.
  std::vector<int> at_limit;
};

/// Searches a standing posture by inverse kinematics with the hierarchical
/// solver. Each step of the search minimizes errors, in this order of priority:
///  1. joint limits, with a margin of 5 % of the range, at most 0.05 rad or m;
///     and couplings,
///  2. tilt, height, heading and position of the soles,
///  3. horizontal distance of the center of mass from its target, and its
///     distance from goal.support->height if that is set,
///  4. lean of the base, and deviation from the rest distance of the feet,
///  5. distance of the joints from goal.joints.
///
/// The target of the center of mass is above the middle of the soles. If half
/// of an ankle's torque could not hold the robot there on one foot, the target
/// is as much nearer to the ankles as needed.
///
/// Costs about 40 steps, each one solve: 0.1 s in all for 100 joints.
/// @pre The robot has two feet, the left one first.
Posture FindPosture(const Robot& robot, const PostureGoal& goal);

}  // namespace poise
