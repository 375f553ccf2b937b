// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/mujoco_plant.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <random>

#include "dynamics/tick.h"
#include "tests/util/decompositions.h"
#include "tests/util/random_tree.h"
#include "tests/util/simple_robots.h"

namespace poise {
namespace {

// MuJoCo finds the principal axes of an inertia to some seven digits.
constexpr double kAgreement = 1e-6;

TEST(MujocoPlant, ReturnsTheStateItWasGiven) {
  std::mt19937 draw(1);
  const Tree tree = MakeRandomTree(12, &draw);
  MujocoPlant plant(MakeRobot(tree));
  const Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
  const Eigen::VectorXd v = MakeRandomVector(tree.nv(), &draw);
  plant.Reset(q, v);
  EXPECT_EQ(plant.Sense().q, q);
  EXPECT_EQ(plant.Sense().v, v);
}

TEST(MujocoPlant, AgreesWithDynamicsInFreeFlight) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 draw(seed);
    const Tree tree = MakeRandomTree(50, &draw);
    MujocoPlant plant(MakeRobot(tree));
    Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
    q.z() += 100;
    const Eigen::VectorXd v = MakeRandomVector(tree.nv(), &draw);
    const Eigen::VectorXd tau = 10 * MakeRandomVector(50, &draw);
    const int frame = *tree.FindFrame("link30");
    const AppliedForce push{
        tree.frames()[frame].body, MakeRandomVector(3, &draw),
        5 * MakeRandomVector(3, &draw), 20 * MakeRandomVector(3, &draw)};
    plant.Reset(q, v);
    plant.Apply(push);
    plant.Step(tau);

    Tick tick(tree, {frame});
    ComputeTick(tree, q, v, &tick);
    const FrameTick& at = tick.frames[0];
    Vector6d F_Bo_W;
    F_Bo_W << push.torque_W + (at.X_WF.R * push.p_BoQ_B).cross(push.force_W),
        push.force_W;
    Eigen::VectorXd force = -tick.N + at.J_WF_W.transpose() * F_Bo_W;
    force.tail(50) += tau;
    const Eigen::VectorXd expected = LeastSquaresSolution(tick.M, force).x;
    EXPECT_LE((plant.Sense().vdot - expected).norm(),
              kAgreement * expected.norm());
  }
}

TEST(MujocoPlant, RepeatsToTheBitAfterReset) {
  MujocoPlant plant(MakeBlock({0.2, 0.1, 0.3}, 5));
  const auto run = [&plant] {
    Eigen::VectorXd q(7), v = Eigen::VectorXd::Zero(6);
    q << 0, 0, 0.2, 0, 0, 0, 1;
    v << 1, 2, 0, 0.5, 0.1, 0;
    plant.Reset(q, v);
    for (int k = 0; k < 300; ++k) plant.Step(Eigen::VectorXd());
    return plant.Sense().q;
  };
  const Eigen::VectorXd once = run();
  EXPECT_EQ(run(), once);
}

TEST(MujocoPlant, LeavesNoFileWhereARobotIsFlungApart) {
  MujocoPlant plant(MakeBlock({0.2, 0.1, 0.3}, 5));
  Eigen::VectorXd q(7);
  q << 0, 0, 0.2, 0, 0, 0, 1;
  plant.Reset(q, Eigen::VectorXd::Constant(6, 1e12));
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (int k = 0; k < 10; ++k) plant.Step(Eigen::VectorXd());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_FALSE(std::ifstream("MUJOCO_LOG.TXT").is_open());
}

// A hinge with damping d on an inertia I slows down as
// w' = -d w / I, whatever the step.
TEST(MujocoPlant, DampsAndHoldsJointsAsTheModelSays) {
  Inertia base, rotor;
  base.mass = rotor.mass = 1;
  base.I_G_B = rotor.I_G_B = Eigen::Matrix3d::Identity();
  JointSpec hinge;
  hinge.name = "hinge";
  hinge.type = JointType::kRevolute;
  hinge.parent = "base";
  hinge.child = "rotor";
  hinge.axis_F = Eigen::Vector3d::UnitZ();
  hinge.armature = 1;
  Robot robot = MakeRobot(TreeBuilder()
                              .AddLink("base", base)
                              .AddLink("rotor", rotor)
                              .AddJoint(hinge)
                              .Build(BaseType::kFixed));
  robot.model.limits[0].damping = 4;
  MujocoPlant plant(robot);
  plant.Reset(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  for (int k = 0; k < 1000; ++k) plant.Step(Eigen::VectorXd::Zero(1));
  // Rotor and armature: I = 2. Implicit Euler: to half a step of the rate.
  EXPECT_NEAR(plant.Sense().v[0], std::exp(-2.0), 1e-3 * std::exp(-2.0) * 2.1);

  robot.model.limits[0].friction = 0.5;
  MujocoPlant held(robot);
  for (int k = 0; k < 1000; ++k) held.Step(Eigen::VectorXd::Constant(1, 0.4));
  EXPECT_NEAR(held.Sense().q[0], 0, 1e-3);
  for (int k = 0; k < 1000; ++k) held.Step(Eigen::VectorXd::Constant(1, 0.6));
  EXPECT_GT(held.Sense().q[0], 5e-3);
}

}  // namespace
}  // namespace poise
