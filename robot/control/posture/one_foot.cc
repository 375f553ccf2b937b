// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/one_foot.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "poise/dynamics/tick.h"
#include "poise/math/so3.h"
#include "poise/robot/control/posture/ankle_reach.h"
#include "poise/robot/control/posture/sole_rows.h"
#include "poise/robot/feet/knee.h"
#include "poise/robot/nominal_tick.h"

namespace poise {
namespace {

using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Largest load of a motor at rest, so that 0.2 of its torque can move the
// robot.
constexpr double kFullLoad = 0.8;
// With a larger load of an upright trunk, robots fell although a posture was
// found: the motors could not move the trunk.
constexpr double kMostLoad = 1.5;
// Fraction of the sole's half width by which a shift ends inside of its middle.
constexpr double kInside = 0.25;
// Height of the other sole, relative to that of the center of mass.
constexpr double kLift = 0.03;
// Largest lean, and the steps of the search, rad.
constexpr double kMostLean = 0.45;
constexpr double kLeanStep = 0.05;

// Returns the largest ratio of a torque to its limit.
double Load(const Robot& robot, int foot, const VectorXd& q) {
  const VectorXd tau = TorquesOnOneFoot(robot, foot, q);
  double load = 0;
  for (int j = 0; j < tau.size(); ++j) {
    const double effort = robot.model.limits[j].effort;
    // A joint without a motor carries what it carries at any lean.
    if (effort > 0) load = std::max(load, std::abs(tau[j]) / effort);
  }
  return load;
}

Eigen::Matrix3d Orientation(const VectorXd& q) {
  return Eigen::Quaterniond(q.segment<4>(3)).toRotationMatrix();
}

// Returns how far to the inner side of the sole's middle AnkleReach() allows
// the center of mass, m. In a leg without a roll joint at the ankle, the joint
// is that of the hip, which reaches far.
double ReachInside(const Robot& robot, int foot) {
  const Tick tick = NominalTick(robot);
  const Foot& sole = robot.feet[foot];
  const Pose X_WC = tick.X_WB[sole.body] * sole.X_BC;
  const auto ankle =
      FindAnkle(robot.model.tree, sole.body, tick.X_WB, X_WC.R.col(0));
  if (!ankle) return kInfinity;
  const double y = (X_WC.Inverse() * tick.X_WB[*ankle + 1].p).y();
  const double inward = foot == 0 ? -1 : 1;
  return std::max(0., inward * y + AnkleReach(robot, *ankle));
}

OneFootPosture Lean(const Robot& robot, const SingleSupport& support) {
  PostureGoal goal;
  goal.fixed = IsInNoLeg(robot);
  goal.support = support;
  OneFootPosture result;
  result.lean = support.lean;
  result.posture = FindPosture(robot, goal);
  result.load = kInfinity;
  if (!result.posture.lack.empty()) return result;
  result.lean_W = LogSo3(Orientation(result.posture.q) *
                         Orientation(robot.q_nominal).transpose());
  result.lean_W.z() = 0;
  result.load = Load(robot, support.foot, result.posture.q);
  return result;
}

}  // namespace

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

std::vector<bool> IsInNoLeg(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  std::vector<bool> is_in_no_leg(tree.num_joints(), true);
  for (const Foot& foot : robot.feet) {
    for (int b = foot.body; b > 0; b = tree.joints()[b - 1].parent) {
      is_in_no_leg[b - 1] = false;
    }
  }
  return is_in_no_leg;
}

Eigen::Vector3d ShiftedCenterOfMass(const Robot& robot, int foot,
                                    const std::vector<Pose>& X_WC,
                                    const Eigen::Vector3d& p_WG) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Pose& each : X_WC) {
    middle += each.p.head<2>() / static_cast<double>(X_WC.size());
  }
  Eigen::Vector2d way = X_WC[foot].p.head<2>() - middle;
  const double inside = std::min(kInside * robot.feet[foot].half_size.y(),
                                 ReachInside(robot, foot));
  if (way.norm() > inside) way -= inside * way.normalized();
  Eigen::Vector3d place = p_WG;
  place.head<2>() += way;
  return place;
}

OneFootPosture FindOneFootPosture(const Robot& robot, int foot,
                                  const Eigen::Vector2d& G) {
  const Tick tick = NominalTick(robot);
  const Foot& sole = robot.feet[foot];
  const double ground = (tick.X_WB[sole.body] * sole.X_BC.p).z();
  SingleSupport support{foot, kLift * (tick.p_WG.z() - ground), G};
  OneFootPosture best = Lean(robot, support);
  if (best.load > kMostLoad && best.posture.lack.empty()) return best;
  const double side = foot == 0 ? 1 : -1;
  for (double lean = kLeanStep;
       best.load > kFullLoad && lean < kMostLean + kLeanStep / 2;
       lean += kLeanStep) {
    support.lean = side * lean;
    const OneFootPosture next = Lean(robot, support);
    if (next.load < best.load) best = next;
  }
  return best;
}

}  // namespace poise
