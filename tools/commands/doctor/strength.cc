// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/strength.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "poise/robot/control/command.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/tick_report.h"

namespace poise {
namespace {

// Largest rate of momentum that counts as zero, relative to the weight. A robot
// whose center of mass is outside its soles by 1 % of its height has more.
constexpr double kHeld = 0.01;
// Excess of a torque outside the legs that is not reported, relative to weight
// times height of the center of mass. A finger needs less.
constexpr double kSmallTorque = 1e-4;
// Excess of a torque that is rounding, relative to the limit.
constexpr double kMissed = 1e-6;

// Returns which joints are between the base and a foot.
std::vector<bool> FindLegJoints(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  std::vector<bool> is_leg(tree.num_joints());
  for (const Foot& foot : robot.feet) {
    for (int b = foot.body; b > 0; b = tree.joints()[b - 1].parent) {
      is_leg[b - 1] = true;
    }
  }
  return is_leg;
}

}  // namespace

// Solves one tick at rest with the torque limits on a level below the posture.
// The slack of a violated torque limit then shows how much torque the posture
// needs. The momentum changes if the soles cannot give the contact forces that
// balance the robot. Accelerations of joints tell nothing: a joint at its stop
// moves away from the stop, and other joints balance it.
std::vector<Finding> FindWeakness(const Robot& robot) {
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
  const double gravity = tree.gravity_W().norm();
  const double height = std::abs(controller.tick().p_WG.z());
  const double small = kSmallTorque * tree.total_mass() * gravity * height;
  const std::vector<bool> is_leg = FindLegJoints(robot);
  std::vector<Finding> findings;
  const TickReport& report = controller.report();
  for (const ActiveRow& row : report.active) {
    if (row.task != limits || row.slack <= kMissed) continue;
    const Joint& joint = tree.joints()[row.row];
    const double effort = robot.model.limits[row.row].effort;
    const double scale = effort > 0 ? effort : 1;  // The row is divided by it.
    if (!is_leg[row.row] && row.slack * scale <= small) continue;
    const char* unit = joint.type == JointType::kPrismatic ? " N" : " N m";
    findings.push_back(
        {Severity::kWarn, "joint " + Quoted(joint.name),
         "needs " + PrintNumber(effort + row.slack * scale) + unit +
             " (limit " + PrintNumber(effort) + unit + ") to stand",
         effort > 0 ? "the motor is too weak for the standing posture"
                    : "the file gives the joint no motor: correct "
                      "<limit effort=\"0\">"});
  }
  // At rest the rate of momentum is H_G v̇.
  const Eigen::Matrix<double, 6, 1> rate =
      controller.tick().H_G * report.y.head(tree.nv());
  const double lacking =
      std::max(rate.head<3>().norm() / height, rate.tail<3>().norm());
  if (!(lacking <= kHeld * tree.total_mass() * gravity)) {
    findings.push_back(
        {Severity::kWarn, "robot", "cannot hold its posture",
         "its soles cannot give the contact forces that balance it"});
  }
  return findings;
}

}  // namespace poise
