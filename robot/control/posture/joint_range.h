// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/robot.h"

namespace poise {

/// The joint angles that an inverse-kinematics problem may use, rad or m.
struct JointRange {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// Returns the joint limits with a margin on both sides: 5 % of the range, but
/// at most 0.05 rad or m. A joint without range has no margin.
JointRange RangeInside(const RobotModel& model);

/// Returns q with each joint outside its range moved to the nearest end.
Eigen::VectorXd Clamp(const JointRange& range, const RobotModel& model,
                      Eigen::VectorXd q);

/// Adds the limits of one step to level 0. Each variable moves by at most
/// `longest`, rad or m, and each joint stays in its range. A joint outside its
/// range may stay where it is. Equalities fix joints without range and keep
/// mimic couplings, if both joints are variables. Does not allocate.
///
/// @param column_of  the variable of each joint, or -1 if the joint is fixed.
/// @pre The variables of the hierarchy are the base's six and those joints.
void AddStepLimits(const JointRange& range, const RobotModel& model,
                   const Eigen::VectorXd& q, const std::vector<int>& column_of,
                   int variables, double longest, Hierarchy* hierarchy);

/// Returns the variable joints of q that are at an end of their range, to 1e-6.
std::vector<int> JointsAtLimit(const JointRange& range, const RobotModel& model,
                               const Eigen::VectorXd& q,
                               const std::vector<int>& column_of);

}  // namespace poise
