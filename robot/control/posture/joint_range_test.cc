// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/joint_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/robot/control/posture/biped_fixture.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

// Largest error of a feasible step, rad: the accuracy of the solver.
constexpr double kMet = 1e-9;

RobotModel Biped() {
  RobotModel model = UrdfDocument(BipedText({}), "biped.urdf").MakeModel();
  // Joint 3 has no range; joint 5 has a small one.
  model.limits[3].lower = model.limits[3].upper = 0.1;
  model.limits[5].lower = -0.1;
  model.limits[5].upper = 0.1;
  return model;
}

Eigen::VectorXd AtRest(const RobotModel& model) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(model.tree.nq());
  q[6] = 1;
  return q;
}

TEST(JointRange, HasMarginOfTheRange) {
  const RobotModel model = Biped();
  const JointRange range = RangeInside(model);
  EXPECT_EQ(range.lower[3], range.upper[3]);
  EXPECT_DOUBLE_EQ(range.lower[5], -0.09);
  EXPECT_DOUBLE_EQ(range.upper[5], 0.09);
  EXPECT_DOUBLE_EQ(range.lower[0], model.limits[0].lower + 0.05);
  Eigen::VectorXd q = AtRest(model);
  const int start = model.tree.q_start();
  q[start] = 9;
  q[start + 5] = -9;
  const Eigen::VectorXd inside = Clamp(range, model, q);
  EXPECT_EQ(inside[start], range.upper[0]);
  EXPECT_EQ(inside[start + 5], range.lower[5]);
  EXPECT_EQ(inside.head(7), q.head(7));
}

// A step that should move each variable by `wanted` ends at the nearest point
// that the limits allow.
TEST(JointRange, StepsEndInsideOfTheRange) {
  RobotModel model = Biped();
  model.mimics.push_back({7, 8, 2, 0.1});
  const int n = model.tree.num_joints();
  const int nv = model.tree.nv();
  const int start = model.tree.q_start();
  const JointRange range = RangeInside(model);
  Eigen::VectorXd q = AtRest(model);
  q[start + 4] = 1.9;   // Near its upper end, 1.95.
  q[start + 5] = 0.5;   // Outside, above.
  q[start + 3] = 0.05;  // Off the only angle.
  q[start + 7] = 0.1;   // As its coupling wants.
  std::vector<int> column_of(n);
  for (int j = 0; j < n; ++j) column_of[j] = 6 + j;
  const std::vector<LevelCapacity> capacity = {{n + 1, nv}, {nv, 0}};
  for (const double wanted : {1.0, 0.2, -0.2, -1.0}) {
    constexpr double kLongest = 0.3;
    Hierarchy hierarchy(nv, capacity);
    Solution solution(nv, capacity);
    Solver solver(nv, capacity);
    hierarchy.Clear(2);
    AddStepLimits(range, model, q, column_of, nv, kLongest, &hierarchy);
    EqualityBlock goal = hierarchy.AddEqualities(1, nv);
    goal.B.setIdentity();
    goal.b.setConstant(-wanted);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    const Eigen::VectorXd& y = solution.y;
    const double step = std::clamp(wanted, -kLongest, kLongest);
    EXPECT_NEAR(y[0], step, kMet);
    EXPECT_NEAR(y[6 + 3], 0, kMet);
    EXPECT_NEAR(y[6 + 4], std::min(step, 0.05), kMet);
    // A joint outside returns, but is not forced to.
    EXPECT_NEAR(y[6 + 5], std::min(step, 0.), kMet);
    EXPECT_NEAR(q[start + 7] + y[6 + 7], 2 * (q[start + 8] + y[6 + 8]) + 0.1,
                kMet);
    EXPECT_GT(y[6 + 8] * wanted, 0);
  }
}

TEST(JointRange, NamesVariablesAtTheirLimits) {
  const RobotModel model = Biped();
  const JointRange range = RangeInside(model);
  const int start = model.tree.q_start();
  Eigen::VectorXd q = AtRest(model);
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    q[start + j] = 0.5 * (range.lower[j] + range.upper[j]);
  }
  std::vector<int> column_of(model.tree.num_joints(), 9);
  // A joint without range is always at its limits.
  EXPECT_EQ(JointsAtLimit(range, model, q, column_of), std::vector<int>({3}));
  q[start] = range.lower[0];
  q[start + 1] = range.upper[1];
  q[start + 2] = range.upper[2];
  column_of[2] = column_of[3] = -1;
  EXPECT_EQ(JointsAtLimit(range, model, q, column_of),
            std::vector<int>({0, 1}));
}

}  // namespace
}  // namespace poise
