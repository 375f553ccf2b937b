// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/joint_range.h"

#include <algorithm>

namespace poise {
namespace {

// Margin to each joint limit: kMarginFraction of the range, but at most
// kLargestMargin, rad or m.
constexpr double kMarginFraction = 0.05;
constexpr double kLargestMargin = 0.05;

}  // namespace

JointRange RangeInside(const RobotModel& model) {
  const int n = model.tree.num_joints();
  JointRange range{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int j = 0; j < n; ++j) {
    const JointLimits& limits = model.limits[j];
    const double margin = std::min(
        kLargestMargin, kMarginFraction * (limits.upper - limits.lower));
    range.lower[j] = limits.lower + margin;
    range.upper[j] = limits.upper - margin;
  }
  return range;
}

Eigen::VectorXd Clamp(const JointRange& range, const RobotModel& model,
                      Eigen::VectorXd q) {
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    double& angle = q[model.tree.q_start() + j];
    angle = std::max(range.lower[j], std::min(angle, range.upper[j]));
  }
  return q;
}

void AddStepLimits(const JointRange& range, const RobotModel& model,
                   const Eigen::VectorXd& q, const std::vector<int>& column_of,
                   int variables, double longest, Hierarchy* hierarchy) {
  const int start = model.tree.q_start();
  InequalityBlock steps = hierarchy->AddInequalities(0, variables);
  steps.C.setIdentity();
  steps.lower.setConstant(-longest);
  steps.upper.setConstant(longest);
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const int row = column_of[j];
    if (row < 0) continue;
    const double to_lower = range.lower[j] - q[start + j];
    const double to_upper = range.upper[j] - q[start + j];
    steps.lower[row] = std::max(-longest, std::min(0., to_lower));
    steps.upper[row] = std::min(longest, std::max(0., to_upper));
    if (range.lower[j] < range.upper[j]) continue;
    hierarchy->AddEqualities(0, 1).B(0, row) = 1;  // No range: fixed joint.
  }
  for (const MimicCoupling& mimic : model.mimics) {
    const int column = column_of[mimic.joint];
    const int source = column_of[mimic.source];
    if (column < 0 || source < 0) continue;
    EqualityBlock coupling = hierarchy->AddEqualities(0, 1);
    coupling.B(0, column) = 1;
    coupling.B(0, source) = -mimic.multiplier;
    coupling.b[0] = q[start + mimic.joint] -
                    mimic.multiplier * q[start + mimic.source] - mimic.offset;
  }
}

std::vector<int> JointsAtLimit(const JointRange& range, const RobotModel& model,
                               const Eigen::VectorXd& q,
                               const std::vector<int>& column_of) {
  constexpr double kAtLimit = 1e-6;  // rad or m.
  std::vector<int> at_limit;
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const double angle = q[model.tree.q_start() + j];
    if (column_of[j] < 0) continue;
    if (angle > range.lower[j] + kAtLimit &&
        angle < range.upper[j] - kAtLimit) {
      continue;
    }
    at_limit.push_back(j);
  }
  return at_limit;
}

}  // namespace poise
