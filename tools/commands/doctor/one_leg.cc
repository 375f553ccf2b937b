// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/one_leg.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/posture/find_posture.h"
#include "poise/robot/control/posture/sole_rows.h"

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// Smallest width of a sole to balance on, as a fraction of the height of the
// center of mass. The pendulum then has 0.2 m/s² to each side.
constexpr double kNarrow = 0.04;
// Height of the other sole, relative to that of the center of mass.
constexpr double kLift = 0.03;
// The center of mass stays within this fraction of the sole's half sides.
constexpr double kInsideSole = 0.6;
// Before the other foot is lifted, the center of mass is over the sole, at this
// fraction of its half width inside of the middle.
constexpr double kShift = 0.25;
// A joint without a motor holds this torque, as a fraction of the weight times
// the height: smaller torques come from rounding and from the posture search.
constexpr double kRounding = 1e-6;

// Returns the torques at rest of a robot that stands on one foot:
//     tau = N_j - J_j' lambda,   J_b' lambda = N_b,
// with the rows b of the base and j of the joints.
VectorXd TorquesOnOneFoot(const Robot& robot, int foot, const VectorXd& q) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {robot.feet[foot].frame});
  ComputeTick(tree, q, VectorXd::Zero(tree.nv()), &tick);
  std::vector<int> all(tree.nv());
  std::iota(all.begin(), all.end(), 0);
  const Eigen::MatrixXd J = StateOf(robot.feet[foot], tick, 0, all).J_WC_W;
  const int n = tree.num_joints();
  const VectorXd lambda =
      J.leftCols<6>().transpose().partialPivLu().solve(tick.N.head<6>());
  return tick.N.tail(n) - J.rightCols(n).transpose() * lambda;
}

// Returns the reason why a motor is too weak, or "": the joint with the largest
// ratio of the torque to its limit.
std::string WeakMotor(const Robot& robot, const VectorXd& tau, double height) {
  const Tree& tree = robot.model.tree;
  const double weight = tree.total_mass() * tree.gravity_W().norm();
  std::string reason;
  double worst = 1;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double effort = robot.model.limits[j].effort;
    const double holds = effort + robot.model.limits[j].friction;
    const Joint& joint = tree.joints()[j];
    const bool is_prismatic = joint.type == JointType::kPrismatic;
    const double least = kRounding * weight * (is_prismatic ? 1 : height);
    const double ratio = std::abs(tau[j]) / std::max(holds, least);
    if (!(ratio > worst)) continue;  // Also without a limit.
    worst = ratio;
    const char* unit = is_prismatic ? " N" : " N m";
    reason = "joint " + Quoted(joint.name) + " needs " +
             PrintNumber(std::abs(tau[j])) + unit + " (limit " +
             PrintNumber(effort) + unit + ")";
  }
  return reason;
}

// Returns the error of a posture and a joint at its limit in words, or "".
std::string Lack(const Robot& robot, const Posture& posture) {
  if (posture.lack.empty() || posture.at_limit.empty()) return posture.lack;
  const Joint& joint = robot.model.tree.joints()[posture.at_limit[0]];
  return posture.lack + ", with joint " + Quoted(joint.name) + " at its limit";
}

// Returns the reason why the center of mass cannot move over a foot while both
// soles lie flat, or "". Legs without a roll joint at the ankle cannot do it.
std::string WhyNoShift(const Robot& robot, int foot) {
  const double inward = foot == 0 ? -1 : 1;
  PostureGoal goal;
  goal.support =
      SingleSupport{foot,
                    0,
                    {0, kShift * inward * robot.feet[foot].half_size.y()},
                    /*keeps_other=*/true};
  const std::string lack = Lack(robot, FindPosture(robot, goal));
  return lack.empty() ? "" : "with both soles flat, " + lack;
}

// Returns the reason why the robot cannot stand on a foot, or "".
std::string Reason(const Robot& robot, int foot, double height) {
  const Foot& sole = robot.feet[foot];
  const double width = 2 * sole.half_size.y();
  if (width < kNarrow * height) {
    return "its sole is " + PrintNumber(width) + " m wide, must be " +
           PrintNumber(kNarrow * height) + " m for a center of mass at " +
           PrintNumber(height) + " m";
  }
  const std::string shift = WhyNoShift(robot, foot);
  if (!shift.empty()) return shift;
  // The foot's origin is at or near the ankle.
  const Vector2d ankle = sole.X_BC.Inverse().p.head<2>();
  const Vector2d inside = kInsideSole * sole.half_size;
  std::string reason;
  for (const Vector2d& G :
       {Vector2d(0, 0), Vector2d(ankle.cwiseMax(-inside).cwiseMin(inside))}) {
    PostureGoal goal;
    goal.support = SingleSupport{foot, kLift * height, G};
    const Posture posture = FindPosture(robot, goal);
    std::string lack = Lack(robot, posture);
    if (lack.empty()) {
      lack = WeakMotor(robot, TorquesOnOneFoot(robot, foot, posture.q), height);
    }
    if (lack.empty()) return "";
    if (reason.empty()) reason = lack;
  }
  return reason;
}

}  // namespace

std::vector<Finding> FindOneLegDefects(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, VectorXd::Zero(tree.nv()), &tick);
  std::vector<Finding> findings;
  for (const int foot : {0, 1}) {
    const std::string reason = Reason(robot, foot, tick.p_WG.z());
    if (reason.empty()) continue;
    findings.push_back({Severity::kWarn, robot.feet[foot].name,
                        "cannot stand on one leg: " + reason,
                        "the scenario one_leg and steps will fail", 0});
  }
  return findings;
}

}  // namespace poise
