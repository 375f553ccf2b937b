// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/cascade.h"

#include <gtest/gtest.h>

#include <limits>

#include "hqp/certificate.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-14;  // A few operations on numbers near 1.

// y1 <= 1 and y2 >= 2 above y1 + y2 = 4 above y = (5, 0).
class CascadeTest : public testing::Test {
 protected:
  CascadeTest() {
    InequalityBlock bounds = hierarchy_.AddInequalities(0, 2);
    bounds.C.setIdentity();
    bounds.upper[0] = 1;
    bounds.lower[1] = 2;
    EqualityBlock sum = hierarchy_.AddEqualities(1, 1);
    sum.B << 1, 1;
    sum.b << -4;
    EqualityBlock target = hierarchy_.AddEqualities(2, 2);
    target.B.setIdentity();
    target.b << -5, 0;
    target_ = target.b.data();
  }

  const std::vector<LevelCapacity> capacity_{{0, 2}, {1, 0}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
  double* target_;
  Cascade cascade_{2, capacity_};
  Solution solution_{2, capacity_};
  Certifier certifier_{2, capacity_};
};

TEST_F(CascadeTest, SolvesByHand) {
  ASSERT_EQ(cascade_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_NEAR(solution_.y[0], 1, kTolerance);
  EXPECT_NEAR(solution_.y[1], 3, kTolerance);
  EXPECT_NEAR(solution_.levels[2].cost, 12.5, 10 * kTolerance);
  EXPECT_EQ(solution_.levels[0].nullity, 2);
  EXPECT_EQ(solution_.levels[1].nullity, 1);
  EXPECT_EQ(solution_.levels[2].nullity, 0);
  EXPECT_EQ(solution_.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution_.levels[0].active[1], Side::kNone);
  // g = (-4, 3) + lambda (1, 1) + mu (1, 0) = 0.
  EXPECT_NEAR(solution_.levels[2].multipliers[1].equality[0], -3,
              10 * kTolerance);
  EXPECT_NEAR(solution_.levels[2].multipliers[0].inequality[0], 7,
              10 * kTolerance);
  EXPECT_LE(certifier_.Certify(hierarchy_, solution_).worst(), kTolerance);
}

TEST_F(CascadeTest, ReportsWhatIsNotFinite) {
  target_[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cascade_.Solve(hierarchy_, &solution_), Status::kNotFinite);
  EXPECT_EQ(solution_.failed_level, 2);
  EXPECT_EQ(solution_.y, Eigen::Vector2d(0, 0));
}

}  // namespace
}  // namespace poise
