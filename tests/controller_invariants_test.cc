// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "robot/control/controller.h"
#include "tests/util/random_biped.h"
#include "tests/util/random_tree.h"

namespace poise {
namespace {

// What each tick must keep, whatever the robot and its state; in the problem's
// own scale, where a limit or a robot's weight is about 1.
constexpr double kTolerance = 1e-6;
constexpr double kMu = 0.5;

struct Balance {
  Robot robot;
  Controller controller;
  State state;
  Command command;

  explicit Balance(std::mt19937* draw)
      : robot(MakeRandomBiped(draw)), controller(robot) {
    const Tree& tree = robot.model.tree;
    state = {0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
    controller.Start(state);
    command.tau.setZero(tree.num_joints());
  }

  void Update() {
    state.time += 1e-3;
    controller.Update(state, &command);
  }

  double weight() const { return 9.81 * robot.model.tree.total_mass(); }

  // What is broken, or nothing.
  std::string Broken() const {
    const Tree& tree = robot.model.tree;
    if (!command.tau.allFinite()) return "a torque is not finite";
    for (int j = 0; j < tree.num_joints(); ++j) {
      if (std::abs(command.tau[j]) > robot.model.limits[j].effort) {
        return "torque limit of " + tree.joints()[j].name;
      }
    }
    if (command.status != controller.report().status) return "status";
    if (command.status == TickStatus::kFailSafe) return "it failed safe";
    // A hierarchy cut off above the cones says nothing of them.
    const bool has_cones = controller.report().failed_rank == 0 ||
                           controller.report().failed_rank > 3;
    const std::string broken = has_cones ? BrokenByWrenches() : "";
    return broken.empty() ? BrokenByDynamics() : broken;
  }

  // What a task admits to be short of, in N or N m: its rows are divided by a
  // quarter of the weight.
  double Allowed(const char* task) const {
    const int i = *controller.stack().Find(task);
    return (kTolerance + controller.report().tasks[i].slack) * weight() / 4;
  }

  // The cones of the soles: broken no further than the report says.
  std::string BrokenByWrenches() const {
    for (int i = 0; i < static_cast<int>(robot.feet.size()); ++i) {
      const Eigen::Matrix<double, 6, 1> F =
          controller.report().foot_wrench(robot.model.tree.nv(), i);
      const double fz = std::max(F[5], 0.0);
      const Eigen::Vector2d half = robot.feet[i].half_size;
      const double slip = kMu * fz + Allowed("friction");
      const double tilt = Allowed("cop");
      if (F[5] < -Allowed("unilateral")) return "a foot pulls";
      if (std::abs(F[3]) > slip) return "friction in x";
      if (std::abs(F[4]) > slip) return "friction in y";
      if (std::abs(F[1]) > half.x() * fz + tilt) return "CoP in x";
      if (std::abs(F[0]) > half.y() * fz + tilt) return "CoP in y";
      if (std::abs(F[2]) > kMu * half.sum() * fz + Allowed("yaw")) {
        return "yaw moment";
      }
    }
    return "";
  }

  // M v̇ + N = S' tau + J' lambda, all of it where no torque was cut off.
  std::string BrokenByDynamics() const {
    const Tree& tree = robot.model.tree;
    const Tick& tick = controller.tick();
    const Eigen::VectorXd& y = controller.report().y;
    Eigen::VectorXd residual = tick.M * y.head(tree.nv()) + tick.N;
    for (int i = 0; i < static_cast<int>(robot.feet.size()); ++i) {
      residual -= controller.contacts()[i].J_WC_C.transpose() *
                  controller.report().foot_wrench(tree.nv(), i);
    }
    residual.tail(tree.num_joints()) -= command.tau;
    const double scale = weight() + (tick.M * y.head(tree.nv())).norm();
    if (residual.head<6>().norm() > 1e-9 * scale) return "Newton-Euler";
    if (command.status == TickStatus::kOk &&
        residual.norm() > kTolerance * scale) {
      return "torques by (10)";
    }
    return "";
  }
};

RC_GTEST_PROP(ControllerInvariants, StandingStillHoldsAnyBiped, ()) {
  std::mt19937 draw(*rc::gen::inRange<unsigned>(0, 1u << 30));
  Balance run(&draw);
  run.Update();
  RC_ASSERT(run.Broken() == "");
  RC_ASSERT(run.command.status == TickStatus::kOk);
  for (const TaskReport& task : run.controller.report().tasks) {
    RC_ASSERT(task.slack < kTolerance);
  }
  // At rest in its posture: the feet carry its weight.
  const int nv = run.robot.model.tree.nv();
  const double force = run.controller.report().foot_wrench(nv, 0)[5] +
                       run.controller.report().foot_wrench(nv, 1)[5];
  RC_ASSERT(std::abs(force - run.weight()) < 0.2 * run.weight());
}

RC_GTEST_PROP(ControllerInvariants, HoldInAnyPostureAndUnderAnyPush, ()) {
  std::mt19937 draw(*rc::gen::inRange<unsigned>(0, 1u << 30));
  const int posture = *rc::gen::inRange(0, 20);  // Hundredths of a rad.
  const int speed = *rc::gen::inRange(0, 100);   // cm/s, and of the joints.
  const int ticks = *rc::gen::inRange(1, 4);
  Balance run(&draw);
  const Tree& tree = run.robot.model.tree;
  run.state.q.tail(tree.num_joints()) +=
      0.01 * posture * MakeRandomVector(tree.num_joints(), &draw);
  for (int i = 0; i < ticks; ++i) {
    run.state.v = 0.01 * speed * MakeRandomVector(tree.nv(), &draw);
    run.state.v.segment<3>(3) *= 3;  // Enough for a foot to want to slip.
    run.Update();
    RC_ASSERT(run.Broken() == "");
  }
}

TEST(ControllerInvariants, NoticeATorqueBeyondItsLimit) {
  std::mt19937 draw(1);
  Balance run(&draw);
  run.Update();
  ASSERT_EQ(run.Broken(), "");
  run.command.tau[3] = 1.01 * run.robot.model.limits[3].effort;
  EXPECT_NE(run.Broken(), "");
  run.command.tau[3] = 0;
  EXPECT_EQ(run.Broken(), "torques by (10)");
}

}  // namespace
}  // namespace poise
