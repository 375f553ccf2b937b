// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The answer is continuous wherever no level changes rank. A leg changes rank
// when the knee is straight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-13;  // A few operations on numbers up to 4.
constexpr double kExact = 1e-15;      // One or two operations on 0 and 1.

// A leg with two joints. The row of level 1 keeps the trunk upright, and a row
// of level 2 lifts the trunk. In the nullspace of level 1, the norm of the
// lifting row is proportional to sin(knee).
class StraightKneeTest : public testing::Test {
 protected:
  // Solves the hierarchy. Level 2 has the lifting row and one damping row per
  // joint.
  Solution Solve(double knee, double damping, double limit) {
    const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}, {3, 0}};
    Hierarchy hierarchy(2, capacity);
    InequalityBlock limits = hierarchy.AddInequalities(0, 2);
    limits.C.setIdentity();
    limits.lower.setConstant(-limit);
    limits.upper.setConstant(limit);
    EqualityBlock trunk = hierarchy.AddEqualities(1, 1);
    trunk.B << 1, 1;
    EqualityBlock lift = hierarchy.AddEqualities(2, 3);
    lift.B << 1, 1 - std::sin(knee), 1, 0, 0, 1;
    lift.b << -1, 0, 0;
    lift.weight << 1, damping, damping;
    Solution solution(2, capacity), reference(2, capacity);
    EXPECT_EQ(Solver(2, capacity).Solve(hierarchy, &solution),
              Status::kOptimal);
    EXPECT_EQ(Cascade(2, capacity).Solve(hierarchy, &reference),
              Status::kOptimal);
    // Both solvers divide by sin(knee), which loses digits to rounding as the
    // knee straightens.
    EXPECT_LE((solution.y - reference.y).norm(),
              1e-14 * (1 + solution.y.norm()) * (1 + solution.y.norm()));
    EXPECT_EQ(solution.levels[2].nullity, reference.levels[2].nullity);
    return solution;
  }

  // Returns the largest |y(knee + h) - y(knee)| between two knee angles, in
  // steps of h.
  double LargestStep(double from, double to, int steps, double damping,
                     double limit) {
    double largest = 0;
    Eigen::VectorXd last = Solve(from, damping, limit).y;
    for (int i = 1; i <= steps; ++i) {
      const Eigen::VectorXd y =
          Solve(from + i * (to - from) / steps, damping, limit).y;
      largest = std::max(largest, (y - last).norm());
      last = y;
    }
    return largest;
  }

  static constexpr double kUnlimited = 1e12;
};

// y = (1, -1) / sin(knee), clamped at the limit of 4 where sin(knee) < 1/4. So
// the slope is at most sqrt(2) cos(knee) / sin^2(knee) < 16 sqrt(2).
TEST_F(StraightKneeTest, IsContinuousWhereNoRankChanges) {
  for (const int steps : {100, 200, 400}) {
    EXPECT_LE(LargestStep(1, 0.01, steps, 0, 4),
              16 * std::sqrt(2) * 0.99 / steps);
  }
  EXPECT_NEAR(Solve(1, 0, 4).y[0], 1 / std::sin(1), kTolerance);
  EXPECT_NEAR(Solve(0.01, 0, 4).y[0], 4, kTolerance);
}

// As the knee straightens, y grows without bound. At knee = 0 the lifting row
// has no component in the nullspace of level 1, and y has minimum norm.
TEST_F(StraightKneeTest, JumpsWhereItsRankChanges) {
  for (const double knee : {1e-2, 1e-4, 1e-6, 1e-8, -1e-8}) {
    const Solution near = Solve(knee, 0, kUnlimited);
    EXPECT_EQ(near.levels[2].nullity, 0);
    // The row is met to eps |y|, and |y| is 1.5e8 at most.
    EXPECT_NEAR(near.levels[2].cost, 0, std::pow(1e-15 * near.y.norm(), 2));
    // 1 - sin(knee) is rounded by eps / 2, which limits the relative accuracy
    // of the knee angle.
    EXPECT_NEAR(near.y[0] * knee, 1, 1e-15 / std::abs(knee) + knee * knee);
  }
  const Solution straight = Solve(0, 0, kUnlimited);
  EXPECT_EQ(straight.levels[2].nullity, 1);
  EXPECT_NEAR(straight.levels[2].cost, 0.5, kExact);
  EXPECT_NEAR(straight.y.norm(), 0, kExact);
}

// Limits on a level above bound the jump: it is at most twice the limit.
TEST_F(StraightKneeTest, JumpsAtMostBetweenTheLimits) {
  EXPECT_NEAR(Solve(1e-6, 0, 4).y[0], 4, kTolerance);
  EXPECT_NEAR(Solve(0, 0, 4).y[0], 0, kTolerance);
  EXPECT_NEAR(Solve(-1e-6, 0, 4).y[0], -4, kTolerance);
}

// Damping rows of weight d on the same level keep its rank. With s = sin(knee),
// y0 is s / (s^2 + 2 d), with a slope of at most 1 / (2 d).
TEST_F(StraightKneeTest, DoesNotJumpWithDampingOnItsLevel) {
  constexpr double kDamping = 0.01;
  for (const int steps : {100, 200, 400}) {
    EXPECT_LE(LargestStep(-0.5, 0.5, steps, kDamping, kUnlimited),
              std::sqrt(2) / (2 * kDamping) / steps);
  }
  const double s = std::sin(0.1);
  EXPECT_NEAR(Solve(0.1, kDamping, kUnlimited).y[0], s / (s * s + 2 * kDamping),
              kTolerance);
  EXPECT_NEAR(Solve(0, kDamping, kUnlimited).y[0], 0, kTolerance);
}

}  // namespace
}  // namespace poise
