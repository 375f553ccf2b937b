// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/strength.h"

#include <stdexcept>

#include "poise/robot/control/command.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/tick_report.h"

namespace poise {

// Solves one tick at rest with the torque limits on a level below the posture.
// The slack of a violated torque limit then shows how much torque the posture
// needs.
std::vector<Finding> FindWeakness(const Robot& robot) {
  constexpr double kHeld = 1e-3;    // Bound of rounding, rad/s² or m/s².
  constexpr double kMissed = 1e-6;  // Fraction of the limit.
  const Tree& tree = robot.model.tree;
  Controller controller(robot);
  Stack& stack = controller.stack();
  const int limits = stack.Find("torque_limits").value();
  const int last = stack.settings(stack.Find("posture").value()).level + 2;
  if (!stack.SetLevel("torque_limits", last - 1) ||
      !stack.SetLevel("force_regularizer", last)) {
    throw std::logic_error("the stack has no room for two more levels");
  }
  const State rest{0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
  Command command{Eigen::VectorXd::Zero(tree.num_joints())};
  controller.Start(rest);
  controller.Update(rest, &command);
  std::vector<Finding> findings;
  const TickReport& report = controller.report();
  for (const ActiveRow& row : report.active) {
    if (row.task != limits || row.slack <= kMissed) continue;
    const Joint& joint = tree.joints()[row.row];
    const double effort = robot.model.limits[row.row].effort;
    const double scale = effort > 0 ? effort : 1;  // The row is divided by it.
    const char* unit = joint.type == JointType::kPrismatic ? " N" : " N m";
    findings.push_back({Severity::kWarn, "joint " + Quoted(joint.name),
                        "needs " + PrintNumber(effort + row.slack * scale) +
                            unit + " (limit " + PrintNumber(effort) + unit +
                            ") to stand",
                        "the motor is too weak for the standing posture"});
  }
  if (!(report.y.head(tree.nv()).lpNorm<Eigen::Infinity>() <= kHeld)) {
    findings.push_back(
        {Severity::kWarn, "robot", "cannot hold its posture",
         "its soles cannot give the contact forces that balance it"});
  }
  return findings;
}

}  // namespace poise
