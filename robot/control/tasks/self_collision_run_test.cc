// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A run of the controller with and without rows against self-collision.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/robot/collision/collision_model.h"
#include "poise/robot/control/controller.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Moves the humanoid by the accelerations of its controller, without a
// simulator, to a posture in which a hand is inside a thigh. Returns the
// smallest distance of this pair over the run, m.
double SmallestDistance(bool is_on) {
  const Robot robot = LoadHumanoid();
  const Tree& tree = robot.model.tree;
  Controller controller(robot);
  EXPECT_TRUE(controller.stack().Enable("self_collision", is_on));
  State state{0, robot.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
  controller.Start(state);
  // The arm hangs, turned inwards: the hand is 50 mm inside the thigh.
  const auto set = [&](const char* joint, double value) {
    controller.reference().posture[*tree.FindJoint(joint)] = value;
  };
  set("l_shoulder_pitch", 0.2);
  set("l_shoulder_roll", 0);
  set("l_shoulder_yaw", -1.15);
  set("l_elbow", -0.52);
  const CollisionModel model = MakeCollisionModel(robot.model);
  const auto pair = std::find_if(
      model.pairs.begin(), model.pairs.end(), [&](const CollisionPair& each) {
        const std::string& a = model.names[each.a];
        const std::string& b = model.names[each.b];
        return std::minmax(a, b) ==
               std::minmax<std::string>("l_hand", "l_thigh");
      });
  EXPECT_NE(pair, model.pairs.end());
  Command command;
  command.tau.setZero(tree.num_joints());
  std::vector<Pose> X_WB(tree.num_bodies());
  double least = INFINITY;
  constexpr double kDt = 1e-3;
  for (int i = 0; i < 1500; ++i) {
    state.time += kDt;
    controller.Update(state, &command);
    EXPECT_LE(controller.report().certificate.worst(), 1e-9);
    const Eigen::VectorXd vdot = controller.report().y.head(tree.nv());
    const Eigen::VectorXd q = state.q;
    Integrate(tree, q, state.v + kDt / 2 * vdot, kDt, state.q);
    state.v += kDt * vdot;
    ComputePoses(tree, state.q, &X_WB);
    least =
        std::min(least, ComputePairDistance(model, *pair, X_WB, 0).distance);
  }
  return least;
}

TEST(SelfCollision, KeepsAHandOutOfAThigh) {
  EXPECT_LT(SmallestDistance(false), -0.03);
  EXPECT_GE(SmallestDistance(true), 0.8 * 0.0116);
}

}  // namespace
}  // namespace poise
