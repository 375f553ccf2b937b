// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/start_state.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "poise/dynamics/tick.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

// Largest distance of soles and ground after the posture search, m.
constexpr double kStanding = 1e-8;

const Robot& Humanoid() {
  static const Robot robot = LoadHumanoid();
  return robot;
}

std::vector<Pose> Soles(const State& state) {
  const Tree& tree = Humanoid().model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, state.q, state.v, &tick);
  std::vector<Pose> X_WC;
  for (const Foot& foot : Humanoid().feet) {
    X_WC.push_back(tick.X_WB[foot.body] * foot.X_BC);
  }
  return X_WC;
}

TEST(StartState, IsTheNominalPostureAtRestByDefault) {
  const State state = MakeStartState(Humanoid(), {}, {}, 1);
  EXPECT_TRUE(state.q.isApprox(Humanoid().q_nominal, kStanding));
  EXPECT_TRUE(state.v.isZero(0));
  EXPECT_EQ(state.time, 0);
}

TEST(StartState, AppliesSlopeHeadingAndDropToTheSoles) {
  StartSettings start;
  start.heading = 0.7;
  start.drop = 0.03;
  Ground slope;
  slope.roll = 0.1;
  slope.pitch = -0.2;
  const Eigen::Vector3d normal = GroundNormal(slope);
  const auto flat = Soles(MakeStartState(Humanoid(), {}, {}, 1));
  const auto soles = Soles(MakeStartState(Humanoid(), start, slope, 1));
  for (const Pose& X_WC : soles) {
    EXPECT_NEAR(normal.dot(X_WC.p), 0.03, kStanding);
    EXPECT_NEAR(normal.dot(X_WC.R.col(2)), 1, kStanding);
  }
  // The middle of the feet stays above the origin. The line between the feet
  // turns by the heading.
  const Eigen::Vector3d middle = (soles[0].p + soles[1].p) / 2;
  EXPECT_TRUE((middle - 0.03 * normal).isZero(kStanding));
  const Eigen::Vector3d side = soles[0].p - soles[1].p;
  const Eigen::Vector3d flat_side = flat[0].p - flat[1].p;
  EXPECT_NEAR(side.norm(), flat_side.norm(), kStanding);
  // The smallest rotation onto the slope has no component about the normal, so
  // the heading remains when it is undone.
  const Eigen::AngleAxisd R_WS(
      std::acos(normal.z()),
      Eigen::Vector3d::UnitZ().cross(normal).normalized());
  const Eigen::Vector3d back = R_WS.inverse() * side;
  EXPECT_NEAR(std::atan2(flat_side.cross(back).z(), flat_side.dot(back)), 0.7,
              kStanding);
}

TEST(StartState, DrawsJointsOutsideTheLegsWithinTheirLimits) {
  StartSettings start;
  start.joints = 0.5;
  const Robot& robot = Humanoid();
  const Tree& tree = robot.model.tree;
  const State state = MakeStartState(robot, start, {}, 3);
  EXPECT_EQ(state.q, MakeStartState(robot, start, {}, 3).q);
  EXPECT_NE(state.q, MakeStartState(robot, start, {}, 4).q);
  const Eigen::VectorXd moved =
      (state.q - robot.q_nominal).tail(tree.num_joints());
  int awry = 0, still = 0, far = 0;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double q = state.q[tree.q_start() + j];
    EXPECT_LE(std::abs(moved[j]), 0.5);
    EXPECT_GE(q, robot.model.limits[j].lower);
    EXPECT_LE(q, robot.model.limits[j].upper);
    (moved[j] == 0 ? still : awry) += 1;
    far += std::abs(moved[j]) > 0.25;
  }
  // Twelve joints are in the legs. Some other joints may start at a limit.
  EXPECT_GE(still, 12);
  EXPECT_GE(awry, 30);
  EXPECT_GE(far, 8);
  const auto soles = Soles(state),
             nominal = Soles({0, robot.q_nominal, state.v});
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(soles[i].p.isApprox(nominal[i].p, kStanding));
  }
}

}  // namespace
}  // namespace poise
