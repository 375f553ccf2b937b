// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/bullet/bullet_plant.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "poise/dynamics/tick.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

// Relative tolerance for two implementations of dynamics that share no code. It
// is the rounding of a velocity of 1 / s that changes within 1 ms, times the
// condition of M.
constexpr double kAgreement = 1e-9;

TEST(BulletPlant, MomentumRateInFreeFlightIsGravity) {
  std::mt19937 draw(2);
  const Tree tree = MakeRandomTree(50, &draw);
  BulletPlant plant(MakeRobot(tree));
  Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
  q.z() += 100;
  const Eigen::VectorXd v = MakeRandomVector(tree.nv(), &draw);
  plant.Reset(q, v);
  plant.Step(10 * MakeRandomVector(50, &draw));
  Tick tick(tree, {});
  ComputeTick(tree, q, v, &tick);
  Vector6d weight = Vector6d::Zero();
  weight.tail<3>() = tree.total_mass() * tree.gravity_W();
  EXPECT_LE((tick.H_G * plant.Sense().vdot + tick.H_G_bias - weight).norm(),
            kAgreement * tick.H_G_bias.norm());
}

// Semi-implicit Euler falls as z_k = z_0 - g dt^2 k (k + 1) / 2.
TEST(BulletPlant, FallsAsSemiImplicitEulerDoes) {
  std::mt19937 draw(3);
  const Tree tree = MakeRandomTree(20, &draw);
  BulletPlant plant(MakeRobot(tree));
  Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
  q.z() += 100;
  plant.Reset(q, Eigen::VectorXd::Zero(tree.nv()));
  Tick tick(tree, {});
  ComputeTick(tree, q, plant.Sense().v, &tick);
  const Eigen::Vector3d start = tick.p_WG;
  const Eigen::VectorXd tau = Eigen::VectorXd::Zero(20);
  for (int k = 0; k < 1000; ++k) plant.Step(tau);
  ComputeTick(tree, plant.Sense().q, plant.Sense().v, &tick);
  const Eigen::Vector3d fallen = tree.gravity_W() * 1e-6 * 1000 * 1001 / 2;
  // The tolerance is the rounding of 100 m in a thousand steps. The exact
  // parabola differs by 4.9 mm.
  EXPECT_LE((tick.p_WG - start - fallen).norm(), 1e-11);
  EXPECT_DOUBLE_EQ(plant.Sense().time, 1.0);
}

struct Drift {
  double momentum;  // Relative, angular about the center of mass.
  double energy;    // Relative to the kinetic energy.
};

// Returns the drift in a second of free flight without gravity.
Drift MeasureDrift(double dt) {
  std::mt19937 draw(4);
  const Tree tree =
      MakeRandomTree(8, &draw, BaseType::kFloating, Eigen::Vector3d::Zero());
  PlantSettings settings;
  settings.dt = dt;
  BulletPlant plant(MakeRobot(tree), settings);
  plant.Reset(MakeRandomConfiguration(tree, &draw),
              0.5 * MakeRandomVector(tree.nv(), &draw));
  Tick tick(tree, {});
  const auto energy = [&] {
    ComputeTick(tree, plant.Sense().q, plant.Sense().v, &tick);
    return plant.Sense().v.dot(tick.M * plant.Sense().v) / 2;
  };
  const double energy_before = energy();
  const Vector6d momentum_before = tick.L_G;
  for (int k = 0; k < 1 / dt - 0.5; ++k) plant.Step(Eigen::VectorXd::Zero(8));
  const double energy_after = energy();
  return {(tick.L_G - momentum_before).norm() / momentum_before.norm(),
          std::abs(energy_after / energy_before - 1)};
}

TEST(BulletPlant, DriftInFreeFlightIsSmallAndProportionalToTheStep) {
  const Drift coarse = MeasureDrift(1e-3), fine = MeasureDrift(0.5e-3);
  EXPECT_LT(coarse.momentum, 2e-4);  // Measured: 7e-5.
  EXPECT_LT(coarse.energy, 2e-4);    // Measured: 8e-5.
  // The drift is of first order; the second order is below a tenth.
  EXPECT_NEAR(coarse.momentum / fine.momentum, 2, 0.2);
  EXPECT_NEAR(coarse.energy / fine.energy, 2, 0.2);
}

TEST(BulletPlant, RepeatsToTheBitAfterReset) {
  std::mt19937 draw(5);
  Robot robot = MakeBlock({0.2, 0.1, 0.3}, 5);
  BulletPlant plant(robot);
  const auto run = [&plant] {
    Eigen::VectorXd q = plant.Sense().q, v = Eigen::VectorXd::Zero(6);
    q << 0, 0, 0.2, 0, 0, 0, 1;
    v << 1, 2, 0, 0.5, 0.1, 0;
    plant.Reset(q, v);
    for (int k = 0; k < 500; ++k) plant.Step(Eigen::VectorXd());
    return plant.Sense().q;
  };
  const Eigen::VectorXd once = run();
  EXPECT_EQ(run(), once);
  BulletPlant another(robot);
  EXPECT_EQ(run(), once);
}

// A damped hinge obeys w' = -d w / I, with I = 0.19 kg m2. It starts at the
// rest position, where gravity has no moment.
TEST(BulletPlant, DampsLightJointsStably) {
  Robot robot = MakePendulum();
  // An explicit step of 1 ms would multiply the speed by
  // 1 - 1000 * 1e-3 / 0.19 = -4.
  robot.model.limits[0].damping = 1000;
  BulletPlant plant(robot);
  plant.Reset(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  double last = 1;
  for (int k = 0; k < 5; ++k) {
    plant.Step(Eigen::VectorXd::Zero(1));
    // Implicit Euler multiplies the speed by 1 / (1 + d dt / I) per step.
    EXPECT_NEAR(plant.Sense().v[0], last / (1 + 1 / 0.19), 1e-4);
    last = plant.Sense().v[0];
  }
  robot.model.limits[0].damping = 0.19;
  BulletPlant slow(robot);
  slow.Reset(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  for (int k = 0; k < 100; ++k) slow.Step(Eigen::VectorXd::Zero(1));
  // Damping gives exp(-d t / I). Gravity pulls back with w0^2 = 31 / s^2, which
  // gives the cosine.
  EXPECT_NEAR(slow.Sense().v[0], std::exp(-0.1) * std::cos(0.557), 2e-2);
  PlantSettings undamped;
  undamped.joint_damping = false;
  BulletPlant free(robot, undamped);
  free.Reset(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  for (int k = 0; k < 100; ++k) free.Step(Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(free.Sense().v[0], std::cos(0.557), 2e-2);
}

TEST(BulletPlant, HoldsJointsByDryFrictionUpToItsForce) {
  Robot robot = MakePendulum();
  robot.model.limits[0].friction = 1;
  BulletPlant plant(robot);
  plant.Reset(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  for (int k = 0; k < 1000; ++k) plant.Step(Eigen::VectorXd::Constant(1, 0.9));
  EXPECT_LT(plant.Sense().q[0], 2e-4);  // The joint creeps at 0.9e-4 rad/s.
  for (int k = 0; k < 1000; ++k) plant.Step(Eigen::VectorXd::Constant(1, 1.5));
  EXPECT_GT(plant.Sense().q[0], 0.05);
}

TEST(BulletPlant, RejectsArmature) {
  JointSpec hinge;
  hinge.name = "hinge";
  hinge.type = JointType::kRevolute;
  hinge.parent = "a";
  hinge.child = "b";
  hinge.armature = 0.25;
  Inertia M;
  M.mass = 1;
  M.I_G_B = Eigen::Matrix3d::Identity();
  const Tree tree =
      TreeBuilder().AddLink("a", M).AddLink("b", M).AddJoint(hinge).Build();
  try {
    BulletPlant plant(MakeRobot(tree));
    FAIL() << "a joint with armature was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "joint 'hinge': armature is 0.25, must be 0 in a Bullet "
                 "plant");
  }
}

}  // namespace
}  // namespace poise
