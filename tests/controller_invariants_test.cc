// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/robot/control/controller.h"
#include "poise/tests/util/arbitrary.h"
#include "poise/tests/util/random_biped.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// What each tick must keep, whatever the robot and its state; in the problem's
// own scale, where a limit or a quarter of a robot's weight is about 1. The
// solver keeps a row to 1e-9 |C_i| |y|, and |y| goes up to 1e3.
constexpr double kTolerance = 1e-6;
constexpr double kMu = 0.5;
constexpr double kDt = 1e-3;

using Wrench = Eigen::Matrix<double, 6, 1>;

// Which condition of a sole the ground's wrench on it, about and in the axes of
// C, breaks by more than `allowed`, N or N m; or nothing.
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
  // What the joints did that no solution said, and what the last one said.
  Eigen::VectorXd unexpected, expected_v;

  explicit Balance(const BipedCase& from);

  void Update();

  const Eigen::VectorXd& y() const { return controller.report().y; }
  double weight() const { return 9.81 * robot.model.tree.total_mass(); }
  Wrench wrench(int foot) const {
    return y().segment<6>(state.v.size() + 6 * foot);
  }

  // How far a row of this rank may be off, by another solver: the root of the
  // sum of squares that no y can be below. Zero where all can be met.
  double Needed(int rank) const;

  bool CanMeetLimitsAndCones() const {
    return Needed(2) < kTolerance && Needed(3) < kTolerance;
  }

  // What is broken, or nothing: of v̇, λ and τ, not of what the report says.
  std::string Broken() const;

  // (10).
  Eigen::VectorXd Torque() const;

  // Torques and accelerations of the joints beyond what limits allow, in units
  // of the limit, and of ω² rad.
  std::string BrokenByJoints(double allowed) const;

  // M v̇ + N = S' tau + J' lambda: of the base by rank 1, of the joints by the
  // torques, but where they are cut off.
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
    const double share = 1 - std::exp(-kDt / 0.02);
    unexpected += share * ((state.v - expected_v) / kDt - unexpected);
    unexpected = unexpected.cwiseMax(-100).cwiseMin(100);
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
  if (command.status != controller.report().status) return "status";
  if (command.status == TickStatus::kFailSafe) return "it failed safe";
  // A hierarchy cut off says nothing of the levels below.
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
  const double w = 40, margin = 0.008;
  const Eigen::VectorXd tau = Torque();
  for (int j = 0; j < tree.num_joints(); ++j) {
    const JointLimits& limits = robot.model.limits[j];
    const std::string& name = tree.joints()[j].name;
    if (std::abs(command.tau[j]) > limits.effort) return "torque of " + name;
    if (std::abs(tau[j]) > limits.effort * (1 + allowed)) {
      return "torque of " + name + " before it is cut off";
    }
    // As if the joint came to rest at the limit with two poles at -ω.
    const double q = state.q[tree.q_start() + j];
    const double v = state.v[tree.v_start() + j];
    const double a = y()[tree.v_start() + j] + unexpected[tree.v_start() + j];
    const double lower =
        std::max(w * w * (limits.lower + margin - q) - 2 * w * v,
                 -w * (limits.velocity + v));
    const double upper =
        std::min(w * w * (limits.upper - margin - q) - 2 * w * v,
                 w * (limits.velocity - v));
    if (lower > upper) continue;  // Too fast for both.
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
  // The solver's bar, relative to what is added up.
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

RC_GTEST_PROP(ControllerInvariants, StandingStillHoldsAnyBiped, ()) {
  Balance run(*Bipeds());
  run.Update();
  RC_ASSERT(run.Broken() == "");
  RC_ASSERT(run.command.status == TickStatus::kOk);
  RC_ASSERT(run.CanMeetLimitsAndCones());
  // At rest in its posture: the feet carry its weight.
  const double force = run.wrench(0)[5] + run.wrench(1)[5];
  RC_ASSERT(std::abs(force - run.weight()) < 0.2 * run.weight());
}

RC_GTEST_PROP(ControllerInvariants, HoldInAnyPostureAndUnderAnyPush, ()) {
  Balance run(*Bipeds());
  const Tree& tree = run.robot.model.tree;
  // From a posture and push in which all can be met to those in which not.
  const double part = *rc::gen::element(0.03, 1.0);
  const int ticks = *rc::gen::inRange(1, 4);
  run.state.q.tail(tree.num_joints()) +=
      *VectorsXd(tree.num_joints(), 0.2 * part);
  for (int i = 0; i < ticks; ++i) {
    run.state.v = *VectorsXd(tree.nv(), part);
    run.state.v.segment<3>(3) *= 3;  // Enough for a foot to want to slip.
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

// Each just inside and just outside of what it may be, to either side.
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

// A knee as near to its limit, and as fast, as it may be with this
// acceleration, and a little nearer.
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
