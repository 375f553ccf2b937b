// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "sim/make_plant.h"
#include "tests/util/simple_robots.h"

namespace poise {
namespace {

// What any plant must do, whoever computes it.
class PlantTest : public testing::TestWithParam<PlantKind> {
 protected:
  std::unique_ptr<Plant> Make(const Robot& robot,
                              const PlantSettings& settings = {}) const {
    return MakePlant(robot, GetParam(), settings);
  }
};

INSTANTIATE_TEST_SUITE_P(, PlantTest,
                         testing::Values(PlantKind::kBullet,
                                         PlantKind::kMujoco),
                         [](const testing::TestParamInfo<PlantKind>& kind) {
                           return kind.param == PlantKind::kBullet ? "Bullet"
                                                                   : "Mujoco";
                         });

TEST_P(PlantTest, CutsTorquesOffAtTheEffortLimit) {
  Robot robot = MakePendulum();
  robot.model.limits[0].effort = 3;
  PlantSettings settings;
  settings.torque_scale = 0.5;
  const auto plant = Make(robot, settings);
  plant->Step(Eigen::VectorXd::Constant(1, 10));
  EXPECT_EQ(plant->Sense().tau[0], 1.5);
  // I = 0.01 + 2 * 0.3^2; hanging, gravity has no moment. MuJoCo's inertias
  // are good to seven digits.
  EXPECT_NEAR(plant->Sense().vdot[0], 1.5 / 0.19, 1e-6 * 1.5 / 0.19);
  plant->Step(Eigen::VectorXd::Constant(1, -10));
  EXPECT_EQ(plant->Sense().tau[0], -1.5);
}

TEST_P(PlantTest, StopsJointsAtTheirLimits) {
  // Bullet's is passed by a step at the speed of the impact, 4 rad/s; MuJoCo's
  // is soft for 4 ms.
  const double overrun = GetParam() == PlantKind::kBullet ? 5e-3 : 1.6e-2;
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

TEST_P(PlantTest, LetsJointsPassTheirLimitsIfTold) {
  Robot robot = MakePendulum();
  robot.model.limits[0].upper = 0.5;
  PlantSettings settings;
  settings.joint_limits = false;
  const auto plant = Make(robot, settings);
  for (int k = 0; k < 2000; ++k) plant->Step(Eigen::VectorXd::Constant(1, 8));
  EXPECT_GT(plant->Sense().q[0], 1);
}

// What acts on it for a step acts in that step alone.
TEST_P(PlantTest, ForgetsAForceAfterAStep) {
  const auto plant = Make(MakePendulum());
  // 2 N at 0.3 m below the hinge turn it by 0.6 N m.
  plant->Apply({1, {0, 0, -0.3}, {0, 0, 0}, {-2, 0, 0}});
  plant->Step(Eigen::VectorXd::Zero(1));
  EXPECT_NEAR(plant->Sense().vdot[0], 0.6 / 0.19, 1e-6 * 0.6 / 0.19);
  plant->Step(Eigen::VectorXd::Zero(1));
  // The rod has moved by 3 urad, and hangs back by 6 N m / rad.
  EXPECT_NEAR(plant->Sense().vdot[0], 0, 1e-3);
}

}  // namespace
}  // namespace poise
