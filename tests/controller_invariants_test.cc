// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/random_biped.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Tolerance of the conditions that each tick must satisfy, for any robot and
// any state. The tolerance is in the problem's own scale, where a limit or a
// quarter of a robot's weight is about 1. The solver satisfies a row to 1e-9
// |C_i| |y|, and |y| goes up to 1e3.
constexpr double kTolerance = 1e-6;
constexpr double kMu = 0.5;
constexpr double kDt = 1e-3;

using Wrench = Eigen::Matrix<double, 6, 1>;

// Names the contact condition that the ground's wrench F on a sole violates by
// more than `allowed` [N or N m], or returns "". F is about the origin of C and
// in the axes of C.
std::string BrokenBy(const Wrench& F, const Foot& foot, double allowed) {
  const double fz = std::max(F[5], 0.0);
  const Eigen::Vector2d half = foot.half_size;
  if (F[5] < -allowed) return "a foot pulls";
  if (std::abs(F[3]) > kMu * fz + allowed) return "friction in x";
  if (std::abs(F[4]) > kMu * fz + allowed) return "friction in y";
  if (std::abs(F[1]) > half.x() * fz + allowed) return "CoP in x";
  if (std::abs(F[0]) > half.y() * fz + allowed) return "CoP in y";
  if (std::abs(F[2]) > kMu * half.sum() * fz + allowed) return "yaw moment";
  return "";
}

struct Balance {
  Robot robot;
  Controller controller;
  State state;
  Command command;
  // Low-pass filtered unmodelled acceleration, and the velocity that the last
  // solution predicts for the next tick.
  Eigen::VectorXd unexpected, expected_v;

  explicit Balance(const BipedCase& from);

  void Update();

  const Eigen::VectorXd& y() const { return controller.report().y; }
  double weight() const { return 9.81 * robot.model.tree.total_mass(); }
  Wrench wrench(int foot) const {
    return y().segment<6>(state.v.size() + 6 * foot);
  }

  // Returns the smallest violation that this priority level needs: the norm of
  // its residuals at the optimum, computed by the reference solver. No row of
  // the level has to be violated by more. Zero if all rows can be satisfied.
  double Needed(int rank) const;

  bool CanMeetLimitsAndCones() const {
    return Needed(2) < kTolerance && Needed(3) < kTolerance;
  }

  // Names the first violated condition, or returns "". Checks v̇, λ and τ
  // themselves, not the controller's report about them.
  std::string Broken() const;

  // Joint torques τ by equation (10).
  Eigen::VectorXd Torque() const;

  // Names a joint whose torque or acceleration violates a limit by more than
  // `allowed`, or returns "". `allowed` is in units of the limit for torques,
  // and of ω² rad for accelerations.
  std::string BrokenByJoints(double allowed) const;

  // Checks M v̇ + N = S' τ + J' λ, or names what is violated. The base rows are
  // level 1 of the hierarchy. The joint rows define the torques, unless these
  // are clamped.
  std::string BrokenByDynamics() const;
};

Balance::Balance(const BipedCase& from)
    : robot(MakeBiped(from)), controller(robot) {
  const Tree& tree = robot.model.tree;
  state = {0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
  controller.Start(state);
  command.tau.setZero(tree.num_joints());
  unexpected.setZero(tree.nv());
}

void Balance::Update() {
  state.time += kDt;
  if (expected_v.size() > 0) {
    // The times and accelerations of UnmodelledAcceleration scale with the
    // robot, by Froude's rule.
    const FroudeScale scale = MakeFroudeScale(robot);
    const double share = 1 - std::exp(-kDt / (0.02 * scale.time()));
    const double largest = 100 / scale.length;
    unexpected += share * ((state.v - expected_v) / kDt - unexpected);
    unexpected = unexpected.cwiseMax(-largest).cwiseMin(largest);
  }
  controller.Update(state, &command);
  expected_v = state.v + kDt * y().head(state.v.size());
}

double Balance::Needed(int rank) const {
  const Hierarchy& hierarchy = controller.hierarchy();
  const std::vector<LevelCapacity> capacity = controller.stack().capacity();
  const int n = static_cast<int>(y().size());
  Solution solution(n, capacity);
  if (Cascade(n, capacity).Solve(hierarchy, &solution) != Status::kOptimal) {
    return 0;
  }
  double needed = 0;
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    if (controller.stack().priority_level(level) == rank) {
      needed = std::sqrt(2 * solution.levels[level].cost);
    }
  }
  return needed;
}

std::string Balance::Broken() const {
  if (!command.tau.allFinite()) return "a torque is not finite";
  if (command.status != controller.report().status) return "report's status";
  if (command.status == TickStatus::kFailSafe) return "the tick failed safe";
  // A truncated solve guarantees nothing for failed_level and the levels below.
  const int failed_level = controller.report().failed_level;
  std::string broken = BrokenByDynamics();
  if (broken.empty() && (failed_level == 0 || failed_level > 2)) {
    broken = BrokenByJoints(kTolerance + Needed(2));
  }
  if (broken.empty() && (failed_level == 0 || failed_level > 3)) {
    const double allowed = (kTolerance + Needed(3)) * weight() / 4;
    for (int i = 0; i < 2 && broken.empty(); ++i) {
      broken = BrokenBy(wrench(i), robot.feet[i], allowed);
    }
  }
  return broken;
}

Eigen::VectorXd Balance::Torque() const {
  const Tick& tick = controller.tick();
  const int n = robot.model.tree.num_joints();
  Eigen::VectorXd tau = (tick.M * y().head(state.v.size()) + tick.N).tail(n);
  for (int i = 0; i < 2; ++i) {
    tau -=
        controller.contacts()[i].J_WC_C.transpose().bottomRows(n) * wrench(i);
  }
  return tau;
}

std::string Balance::BrokenByJoints(double allowed) const {
  const Tree& tree = robot.model.tree;
  const double w =
      controller.stack().GetParameter("joint_limits", "omega").value();
  const double margin =
      controller.stack().GetParameter("joint_limits", "margin").value();
  const Eigen::VectorXd tau = Torque();
  for (int j = 0; j < tree.num_joints(); ++j) {
    const JointLimits& limits = robot.model.limits[j];
    const std::string& name = tree.joints()[j].name;
    if (std::abs(command.tau[j]) > limits.effort) return "torque of " + name;
    if (std::abs(tau[j]) > limits.effort * (1 + allowed)) {
      return "torque of " + name + " before it is clamped";
    }
    // The bounds let the joint come to rest at its limit, with two poles at -ω.
    const double q = state.q[tree.q_start() + j];
    const double v = state.v[tree.v_start() + j];
    const double a = y()[tree.v_start() + j] + unexpected[tree.v_start() + j];
    const double lower =
        std::max(w * w * (limits.lower + margin - q) - 2 * w * v,
                 -w * (limits.velocity + v));
    const double upper =
        std::min(w * w * (limits.upper - margin - q) - 2 * w * v,
                 w * (limits.velocity - v));
    if (lower > upper) continue;  // No acceleration satisfies both bounds.
    if (a < lower - w * w * allowed) return "lower limit of " + name;
    if (a > upper + w * w * allowed) return "upper limit of " + name;
  }
  return "";
}

std::string Balance::BrokenByDynamics() const {
  const Tick& tick = controller.tick();
  const int nv = static_cast<int>(state.v.size());
  Eigen::VectorXd residual = tick.M * y().head(nv) + tick.N;
  for (int i = 0; i < 2; ++i) {
    residual -= controller.contacts()[i].J_WC_C.transpose() * wrench(i);
  }
  // The solver's tolerance, relative to the terms of the sum.
  const double scale = weight() + (tick.M * y().head(nv)).norm();
  if (residual.head<6>().norm() > 1e-9 * scale) return "Newton-Euler";
  const Eigen::VectorXd tau = Torque();
  for (int j = 0; j < tau.size(); ++j) {
    const double effort = robot.model.limits[j].effort;
    if (std::abs(command.tau[j] - std::clamp(tau[j], -effort, effort)) >
        Rounding(scale, nv + 12)) {
      return "torques by (10)";
    }
  }
  return "";
}

RC_GTEST_PROP(ControllerInvariants, HoldForAnyBipedStandingStill, ()) {
  Balance run(*Bipeds());
  run.Update();
  RC_ASSERT(run.Broken() == "");
  RC_ASSERT(run.command.status == TickStatus::kOk);
  RC_ASSERT(run.CanMeetLimitsAndCones());
  // At rest in the nominal posture the feet carry the robot's weight.
  const double force = run.wrench(0)[5] + run.wrench(1)[5];
  RC_ASSERT(std::abs(force - run.weight()) < 0.2 * run.weight());
}

RC_GTEST_PROP(ControllerInvariants, HoldInAnyPostureAndUnderAnyPush, ()) {
  Balance run(*Bipeds());
  const Tree& tree = run.robot.model.tree;
  // At 0.03 posture and push are so small that all limits and cones can be
  // satisfied. At 1 they often cannot.
  const double part = *rc::gen::element(0.03, 1.0);
  const int ticks = *rc::gen::inRange(1, 4);
  run.state.q.tail(tree.num_joints()) +=
      *VectorsXd(tree.num_joints(), 0.2 * part);
  for (int i = 0; i < ticks; ++i) {
    run.state.v = *VectorsXd(tree.nv(), part);
    run.state.v.segment<3>(3) *= 3;  // Reaches the friction limits.
    run.Update();
    RC_ASSERT(run.Broken() == "");
    RC_ASSERT(part == 1 || run.CanMeetLimitsAndCones());
  }
}

TEST(ControllerInvariants, NoticeATorqueBeyondItsLimit) {
  Balance run({});
  run.Update();
  ASSERT_EQ(run.Broken(), "");
  run.command.tau[3] = 1.01 * run.robot.model.limits[3].effort;
  EXPECT_EQ(run.BrokenByJoints(kTolerance), "torque of l_knee");
  run.command.tau[3] = 0;
  EXPECT_EQ(run.Broken(), "torques by (10)");
}

// Each component is tested 1e-6 inside and 1e-6 outside its bounds, on both
// sides.
TEST(ControllerInvariants, NoticeAWrenchJustOutsideOfItsCone) {
  const Foot foot = MakeBiped({}).feet[0];
  const double fz = 400, X = foot.half_size.x(), Y = foot.half_size.y();
  const struct {
    int entry;
    double limit;
    const char* broken;
  } cases[] = {
      {3, kMu * fz, "friction in x"},
      {4, kMu * fz, "friction in y"},
      {1, X * fz, "CoP in x"},
      {0, Y * fz, "CoP in y"},
      {2, kMu * (X + Y) * fz, "yaw moment"},
  };
  for (const auto& each : cases) {
    for (const double side : {-1.0, 1.0}) {
      Wrench F = fz * Wrench::Unit(5);
      F[each.entry] = side * (each.limit - 1e-6);
      EXPECT_EQ(BrokenBy(F, foot, 0), "");
      F[each.entry] = side * (each.limit + 1e-6);
      EXPECT_EQ(BrokenBy(F, foot, 0), each.broken);
    }
  }
  EXPECT_EQ(BrokenBy(Wrench::Zero(), foot, 0), "");
  EXPECT_EQ(BrokenBy(-1e-6 * Wrench::Unit(5), foot, 0), "a foot pulls");
}

// The knee is first 1e-5 rad farther from its limit than its acceleration
// requires, then 1e-5 rad closer.
TEST(ControllerInvariants, NoticeAJointThatCannotStopBeforeItsLimit) {
  Balance run({});
  run.Update();
  ASSERT_EQ(run.Broken(), "");
  const Tree& tree = run.robot.model.tree;
  const int knee = *tree.FindJoint("l_knee");
  const double a = run.y()[tree.v_start() + knee];
  const double q = run.state.q[tree.q_start() + knee];
  JointLimits& limits = run.robot.model.limits[knee];
  limits.upper = q + 0.008 + a / 1600 + 1e-5;
  EXPECT_EQ(run.BrokenByJoints(kTolerance), "");
  limits.upper -= 2e-5;
  EXPECT_EQ(run.BrokenByJoints(kTolerance), "upper limit of l_knee");
  limits.upper = 3;
  limits.lower = q - 0.008 + a / 1600 + 1e-5;
  EXPECT_EQ(run.BrokenByJoints(kTolerance), "lower limit of l_knee");
}

}  // namespace
}  // namespace poise
