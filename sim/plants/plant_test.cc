// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/plant.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include "poise/dynamics/tick.h"
#include "poise/sim/plants/make_plant.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

// Tests that every plant must pass.
class PlantTest : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Plant> Make(const Robot& robot,
                              const PlantSettings& settings = {}) const {
    return MakePlant(robot, GetParam(), settings);
  }
};

INSTANTIATE_TEST_SUITE_P(, PlantTest, testing::ValuesIn(PlantNames()),
                         [](const auto& plant) { return plant.param; });

TEST_P(PlantTest, ReturnsTheStateOfReset) {
  std::mt19937 draw(1);
  const Tree tree = MakeRandomTree(12, &draw);
  const auto plant = Make(MakeRobot(tree));
  const Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
  const Eigen::VectorXd v = MakeRandomVector(tree.nv(), &draw);
  plant->Reset(q, v);
  EXPECT_EQ(plant->Sense().q, q);
  EXPECT_EQ(plant->Sense().v, v);
  EXPECT_EQ(plant->Sense().time, 0);
}

// Checks M v̇ + N = S' tau + J' F, with v̇ from the plant and all other terms
// from dynamics/.
TEST_P(PlantTest, AgreesWithDynamicsInFreeFlight) {
  // Relative tolerance for two implementations that share no code: the rounding
  // of a velocity of 1 / s that changes within 1 ms, times the condition of M.
  // MuJoCo computes the principal axes of an inertia only to about seven
  // digits.
  const double agreement = GetParam() == "bullet" ? 1e-9 : 1e-6;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 draw(seed);
    const Tree tree = MakeRandomTree(50, &draw);
    const auto plant = Make(MakeRobot(tree));
    Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
    q.z() += 100;  // High above the ground.
    const Eigen::VectorXd v = MakeRandomVector(tree.nv(), &draw);
    const Eigen::VectorXd tau = 10 * MakeRandomVector(50, &draw);
    const int frame = *tree.FindFrame("link30");
    const AppliedForce push{
        tree.frames()[frame].body, MakeRandomVector(3, &draw),
        5 * MakeRandomVector(3, &draw), 20 * MakeRandomVector(3, &draw)};
    const AppliedForce base_push{0, MakeRandomVector(3, &draw),
                                 5 * MakeRandomVector(3, &draw),
                                 20 * MakeRandomVector(3, &draw)};
    plant->Reset(q, v);
    plant->Apply(push);
    plant->Apply(base_push);
    plant->Step(tau);

    Tick tick(tree, {*tree.FindFrame("link0"), frame});
    ComputeTick(tree, q, v, &tick);
    Eigen::VectorXd force = -tick.N;
    force.tail(50) += tau;
    const AppliedForce* pushes[] = {&base_push, &push};
    for (int i = 0; i < 2; ++i) {
      const FrameTick& at = tick.frames[i];
      Eigen::Matrix<double, 6, 1> F_Bo_W;
      F_Bo_W << pushes[i]->torque_W +
                    (at.X_WF.R * pushes[i]->p_BoQ_B).cross(pushes[i]->force_W),
          pushes[i]->force_W;
      force += at.J_WF_W.transpose() * F_Bo_W;
    }
    const Eigen::VectorXd expected = LeastSquaresSolution(tick.M, force).x;
    const Eigen::VectorXd& actual = plant->Sense().vdot;
    EXPECT_LE((actual - expected).norm(), agreement * expected.norm());
    EXPECT_LE((tick.M * actual - force).norm(), agreement * tick.N.norm());
  }
}

TEST_P(PlantTest, ClampsTorquesToTheEffortLimit) {
  Robot robot = MakePendulum();
  robot.model.limits[0].effort = 3;
  PlantSettings settings;
  settings.torque_scale = 0.5;
  const auto plant = Make(robot, settings);
  plant->Step(Eigen::VectorXd::Constant(1, 10));
  EXPECT_EQ(plant->Sense().tau[0], 1.5);
  // I = 0.01 + 2 * 0.3^2. The pendulum hangs, so gravity has no moment.
  // MuJoCo's inertias have seven correct digits.
  EXPECT_NEAR(plant->Sense().vdot[0], 1.5 / 0.19, 1e-6 * 1.5 / 0.19);
  plant->Step(Eigen::VectorXd::Constant(1, -10));
  EXPECT_EQ(plant->Sense().tau[0], -1.5);
}

TEST_P(PlantTest, StopsJointsAtTheirLimits) {
  // The impact has 4 rad/s. In Bullet the joint passes the limit by one step at
  // this speed. MuJoCo's limits are soft with a time constant of 4 ms.
  const double overrun = GetParam() == "bullet" ? 5e-3 : 1.6e-2;
  for (const double sign : {-1, 1}) {
    SCOPED_TRACE(sign);
    Robot robot = MakePendulum();
    robot.model.limits[0].lower = -0.5;
    robot.model.limits[0].upper = 0.5;
    const auto plant = Make(robot);
    double farthest = 0;
    for (int k = 0; k < 2000; ++k) {
      plant->Step(Eigen::VectorXd::Constant(1, 8 * sign));
      farthest = std::max(farthest, sign * plant->Sense().q[0]);
    }
    EXPECT_NEAR(sign * plant->Sense().q[0], 0.5, 1e-4);
    EXPECT_LE(farthest, 0.5 + overrun);
  }
}

TEST_P(PlantTest, LetsJointsPassTheirLimitsIfSwitchedOff) {
  Robot robot = MakePendulum();
  robot.model.limits[0].upper = 0.5;
  PlantSettings settings;
  settings.joint_limits = false;
  const auto plant = Make(robot, settings);
  for (int k = 0; k < 2000; ++k) plant->Step(Eigen::VectorXd::Constant(1, 8));
  EXPECT_GT(plant->Sense().q[0], 1);
}

// A force acts in one step only.
TEST_P(PlantTest, AppliesAForceForOneStep) {
  const auto plant = Make(MakePendulum());
  // 2 N at 0.3 m below the hinge have a moment of 0.6 N m.
  plant->Apply({1, {0, 0, -0.3}, {0, 0, 0}, {-2, 0, 0}});
  plant->Step(Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(plant->Sense().vdot[0], 0.6 / 0.19, 1e-6 * 0.6 / 0.19);
  plant->Step(Eigen::VectorXd::Zero(1));
  // The rod has moved by 3 urad, and gravity pulls it back with 6 N m / rad.
  EXPECT_NEAR(plant->Sense().vdot[0], 0, 1e-3);
}

}  // namespace
}  // namespace poise
