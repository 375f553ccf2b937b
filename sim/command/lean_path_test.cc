// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/lean_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "poise/math/so3.h"
#include "poise/robot/control/posture/one_foot.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d At(const LeanPath& path, double time) {
  Reference reference;
  path.Write(time, &reference);
  return reference.R_WB;
}

TEST(LeanPath, WritesNothingBeforeTheFirstLean) {
  const LeanPath path(ExpSo3(Vector3d(0, 0, 1)));
  EXPECT_EQ(At(path, 1), Matrix3d::Identity());
}

TEST(LeanPath, GoesFromTheStartToTheLeanAndBack) {
  const Matrix3d start = ExpSo3(Vector3d(0.1, 0.2, 1));
  const Vector3d lean_W(-0.3, 0.1, 0);
  LeanPath path(start);
  path.LeanTo(lean_W, 2, 1.5);
  EXPECT_TRUE(At(path, 1).isApprox(start));
  EXPECT_TRUE(At(path, 4).isApprox(ExpSo3(lean_W) * start));
  // The path is symmetric in time, and starts and ends at rest.
  EXPECT_TRUE(At(path, 2.75).isApprox(ExpSo3(Vector3d(lean_W / 2)) * start));
  for (const double time : {2.0, 3.5}) {
    constexpr double kStep = 1e-3;  // s.
    const Vector3d turned =
        LogSo3(At(path, time + kStep) * At(path, time - kStep).transpose());
    // The jerk is 60 |lean| / over^3: 5.6 rad/s3, over 1 ms.
    EXPECT_LT(turned.norm(), 6 * std::pow(kStep, 3));
  }
  path.LeanTo(Vector3d::Zero(), 5, 1);
  EXPECT_TRUE(At(path, 5).isApprox(ExpSo3(lean_W) * start));
  EXPECT_TRUE(At(path, 6).isApprox(start));
}

// The motors of the hips hold 0.95 of what an upright trunk needs on one leg.
TEST(LeanPath, LetsARobotWithWeakHipsStandOnOneLeg) {
  Robot robot = LoadHumanoid();
  for (const int foot : {0, 1}) {
    const std::string name = foot == 0 ? "l_hip_roll" : "r_hip_roll";
    const int hip = robot.model.tree.FindJoint(name).value();
    const OneFootPosture upright = FindOneFootPosture(robot, foot, {0, 0});
    robot.model.limits[hip].effort =
        0.95 * std::abs(TorquesOnOneFoot(robot, foot, upright.posture.q)[hip]);
  }
  Scenario scenario = LoadScenario("sim/scenarios/one_leg.yaml");
  scenario.pushes.clear();
  scenario.duration = 6;
  scenario.stance.resize(2);
  const RunResult result = poise::Run(robot, scenario);
  EXPECT_FALSE(result.verdict.fell_at);
  EXPECT_TRUE(result.commanded_done.value_or(false));
}

}  // namespace
}  // namespace poise
