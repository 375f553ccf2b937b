// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/one_leg.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/posture/find_posture.h"
#include "poise/robot/control/posture/one_foot.h"
#include "poise/robot/nominal_tick.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// Smallest width of a sole to balance on, as a fraction of the height of the
// center of mass. The pendulum then has 0.2 m/s² to each side.
constexpr double kNarrow = 0.04;
// Largest load of a motor at rest: the rest has to balance the robot. In the
// scenario one_leg, a robot with 0.90 recovered, and one with 0.92 fell.
constexpr double kMostLoad = 0.91;
// A joint without a motor needs to hold no torque below this fraction of the
// weight times the height: a finger sags, and the robot stands.
constexpr double kSmall = 1e-3;

// Returns the reason why a motor is too weak, or "": the joint with the largest
// ratio of the torque to its limit.
std::string WeakMotor(const Robot& robot, const VectorXd& tau, double height) {
  const Tree& tree = robot.model.tree;
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  std::string reason;
  double worst = kMostLoad;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double effort = robot.model.limits[j].effort;
    const double holds = effort + robot.model.limits[j].friction;
    const Joint& joint = tree.joints()[j];
    const bool is_prismatic = joint.type == JointType::kPrismatic;
    const double least = kSmall * weight * (is_prismatic ? 1 : height);
    const double ratio = std::abs(tau[j]) / std::max(holds, least);
    if (!(ratio > worst)) continue;  // Also without a limit.
    worst = ratio;
    const char* unit = is_prismatic ? " N" : " N m";
    reason = "joint " + Quoted(joint.name) + " needs " +
             PrintNumber(std::abs(tau[j])) + unit + " (limit " +
             PrintNumber(effort) + unit + ")";
    if (ratio < 1) reason += ", too little is left to balance with";
  }
  return reason;
}

// Returns that a joint between a foot and the base has no motor, or "". At
// rest, such a joint may need no torque; but nothing balances the robot about
// it.
std::string MissingMotor(const Robot& robot, int foot) {
  const Tree& tree = robot.model.tree;
  for (int b = robot.feet[foot].body; b > 0; b = tree.joints()[b - 1].parent) {
    const JointLimits& limits = robot.model.limits[b - 1];
    if (limits.effort != 0 || limits.friction > 0) continue;
    return "joint " + Quoted(tree.joints()[b - 1].name) +
           " has no motor (effort 0) to balance with";
  }
  return "";
}

// Returns the error of a posture and a joint at its limit in words, or "".
std::string Lack(const Robot& robot, const Posture& posture) {
  if (posture.lack.empty() || posture.at_limit.empty()) return posture.lack;
  const Joint& joint = robot.model.tree.joints()[posture.at_limit[0]];
  return posture.lack + ", with joint " + Quoted(joint.name) + " at its limit";
}

// Returns the target of the center of mass in the frame of a foot's sole, m.
Vector2d Target(const Robot& robot, int foot, const Tick& tick) {
  std::vector<Pose> X_WC;
  for (const Foot& each : robot.feet) {
    X_WC.push_back(tick.X_WB[each.body] * each.X_BC);
  }
  const Eigen::Vector3d p_WG =
      ShiftedCenterOfMass(robot, foot, X_WC, tick.p_WG);
  return (X_WC[foot].Inverse() * p_WG).head<2>();
}

// Returns the reason why the center of mass cannot move over a foot while both
// soles lie flat, or "". Legs without a roll joint at the ankle cannot do it.
std::string WhyNoShift(const Robot& robot, int foot, const Vector2d& G) {
  PostureGoal goal;
  goal.support = SingleSupport{foot, 0, G, /*keeps_other=*/true};
  const std::string lack = Lack(robot, FindPosture(robot, goal));
  return lack.empty() ? "" : "with both soles flat, " + lack;
}

// Returns the reason why the robot cannot stand on a foot, or "".
std::string Reason(const Robot& robot, int foot, const Tick& tick) {
  const double height = tick.p_WG.z();
  const double width = 2 * robot.feet[foot].half_size.y();
  if (width < kNarrow * height) {
    return "its sole is " + PrintNumber(width) + " m wide, must be " +
           PrintNumber(kNarrow * height) + " m for a center of mass at " +
           PrintNumber(height) + " m";
  }
  const Vector2d G = Target(robot, foot, tick);
  const std::string shift = WhyNoShift(robot, foot, G);
  if (!shift.empty()) return shift;
  const Posture posture = FindOneFootPosture(robot, foot, G).posture;
  const std::string lack = Lack(robot, posture);
  if (!lack.empty()) return lack;
  const std::string weak =
      WeakMotor(robot, TorquesOnOneFoot(robot, foot, posture.q), height);
  return weak.empty() ? MissingMotor(robot, foot) : weak;
}

}  // namespace

std::vector<Finding> FindOneLegDefects(const Robot& robot) {
  const Tick tick = NominalTick(robot);
  std::vector<Finding> findings;
  for (const int foot : {0, 1}) {
    const std::string reason = Reason(robot, foot, tick);
    if (reason.empty()) continue;
    findings.push_back({Severity::kWarn, robot.feet[foot].name,
                        "cannot stand on one leg: " + reason,
                        "expect the scenario one_leg and steps to fail", 0});
  }
  return findings;
}

}  // namespace poise
