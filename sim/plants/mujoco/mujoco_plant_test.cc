// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/mujoco/mujoco_plant.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>

#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

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

TEST(MujocoPlant, WritesNoWarningFileWhenTheSimulationDiverges) {
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

// A hinge with damping d on an inertia I obeys w' = -d w / I.
TEST(MujocoPlant, AppliesDampingAndDryFrictionOfTheModel) {
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
  // Rotor and armature have I = 2 together. The relative error of implicit
  // Euler is half of the rate times the step, per time constant.
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
