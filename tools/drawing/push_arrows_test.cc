// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/push_arrows.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "poise/math/so3.h"
#include "poise/robot/robot.h"
#include "poise/sim/log/summary.h"
#include "poise/sim/push.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

using Eigen::Vector3d;

constexpr double kEpsilon = 1e-12;

// Two pushes. One has a box profile, from 0.01 to 0.03 s, on the head. The
// other has a half-sine profile, from 0.02 to 0.06 s, on a hand, and its force
// is given in the axes of the hand.
class FindPushArrowsTest : public testing::Test {
 protected:
  FindPushArrowsTest() {
    box_.link = "head";
    box_.force = Vector3d(-20, 0, 0);
    box_.start = 0.01;
    box_.duration = 0.02;
    sine_.link = "l_hand";
    sine_.point = Vector3d(0.01, 0.02, 0.03);
    sine_.frame = PushFrame::kLink;
    sine_.force = Vector3d(0, 100, 0);
    sine_.profile = PushProfile::kHalfSine;
    sine_.start = 0.02;
    sine_.duration = 0.04;
    // No two bodies have the same pose.
    for (int i = 0; i < robot_.model.tree.num_bodies(); ++i) {
      Pose X_WB;
      X_WB.R = ExpSo3(Vector3d(0.1 * i, 0.2, -0.05 * i));
      X_WB.p = Vector3d(i, -2 * i, 0.5 * i);
      X_WB_.push_back(X_WB);
    }
  }

  std::vector<PushArrow> At(double time) const {
    Scenario scenario;
    scenario.duration = 0.1;
    scenario.pushes = {box_, sine_};
    return FindPushArrows(ToJson(robot_, scenario, {}), time, X_WB_);
  }

  // Returns the point on which a push acts, in the world.
  Vector3d PointOf(const Push& push) const {
    const PushOnRobot aimed(robot_, push);
    return X_WB_[aimed.body()] * aimed.p_BoQ_B();
  }

  const Robot robot_ = LoadHumanoid();
  Push box_, sine_;
  std::vector<Pose> X_WB_;
};

TEST_F(FindPushArrowsTest, DrawsEachPushAtItsOwnLinkAndPoint) {
  const std::vector<PushArrow> arrows = At(0.025);
  ASSERT_EQ(arrows.size(), 2u);
  EXPECT_NEAR((arrows[0].point - PointOf(box_)).norm(), 0, kEpsilon);
  EXPECT_NEAR((arrows[1].point - PointOf(sine_)).norm(), 0, kEpsilon);
  EXPECT_GT((arrows[0].point - arrows[1].point).norm(), 0.1);
}

TEST_F(FindPushArrowsTest, DrawsEachPushOnlyDuringItsInterval) {
  EXPECT_TRUE(At(0.005).empty());
  ASSERT_EQ(At(0.015).size(), 1u);
  EXPECT_NEAR((At(0.015)[0].point - PointOf(box_)).norm(), 0, kEpsilon);
  ASSERT_EQ(At(0.04).size(), 1u);
  EXPECT_NEAR((At(0.04)[0].point - PointOf(sine_)).norm(), 0, kEpsilon);
  EXPECT_TRUE(At(0.065).empty());
}

TEST_F(FindPushArrowsTest, DrawsEachPushWithItsOwnForce) {
  const std::vector<PushArrow> arrows = At(0.025);
  ASSERT_EQ(arrows.size(), 2u);
  EXPECT_NEAR((arrows[0].force - Vector3d(-20, 0, 0)).norm(), 0, 1e-9);
  // The expected force is the mean of the half sine over a tick of 1 ms, one
  // eighth of the duration after the start.
  const PushOnRobot aimed(robot_, sine_);
  const Vector3d along = X_WB_[aimed.body()].R * aimed.force() / 100;
  EXPECT_NEAR(arrows[1].force.dot(along), 100 * std::sin(M_PI * 5.5 / 40),
              0.05);
  EXPECT_NEAR(arrows[1].force.cross(along).norm(), 0, 1e-9);
}

TEST_F(FindPushArrowsTest, DrawsNothingWithoutPushes) {
  EXPECT_TRUE(FindPushArrows(nlohmann::json::object(), 0, X_WB_).empty());
}

}  // namespace
}  // namespace poise
