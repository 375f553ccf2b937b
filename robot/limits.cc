// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/limits.h"

#include <algorithm>

#include "poise/robot/finding.h"

namespace poise {

bool IsWithin(const JointLimits& limits, double q) {
  constexpr double kRounding = 1e-6;  // rad or m. Files round numbers.
  return q >= limits.lower - kRounding && q <= limits.upper + kRounding;
}

std::string SayOutside(const std::string& joint, const JointLimits& limits,
                       double q) {
  return Quoted(joint) + " is at " + PrintNumber(q) +
         ", must be inside its limits, " + PrintNumber(limits.lower) + " to " +
         PrintNumber(limits.upper);
}

double JointViolation(const RobotModel& model, const Eigen::VectorXd& q) {
  double worst = 0;
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const double q_j = q[model.tree.q_start() + j];
    worst = std::max(
        {worst, model.limits[j].lower - q_j, q_j - model.limits[j].upper});
  }
  return worst;
}

Eigen::VectorXd RestConfiguration(const RobotModel& model) {
  Eigen::VectorXd q = model.tree.MakeNeutral();
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const JointLimits& limits = model.limits[j];
    q[model.tree.q_start() + j] =
        std::max(limits.lower, std::min(0.0, limits.upper));
  }
  return q;
}

}  // namespace poise
