// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/easing/easing.h"

#include <gtest/gtest.h>

#include <limits>

namespace poise {
namespace {

constexpr double kDt = 1e-3;
const Eigen::Vector2d kLast(1, -2);

// Two variables and a task with two equalities and three inequalities.
class EasingTest : public ::testing::Test {
 protected:
  EasingTest() : rows_(2, {{2, 3}, {2, 0}}), before_(2, {{2, 3}}) {
    EXPECT_EQ(easing_.AddTask(1, 0), 2);
    task_ = easing_.AddTask(2, 3);
    EXPECT_EQ(task_, 3);
    easing_.set_duration(0.01);
  }

  // The residuals at the last y are 4 and -2.
  static EqualityBlock AddEqualities(Hierarchy* rows) {
    rows->Clear(1);
    EqualityBlock equalities = rows->AddEqualities(0, 2);
    equalities.B << 1, 0, 1, 1;
    equalities.b << 3, -1;
    return equalities;
  }

  // Returns the offsets of the two equalities.
  Eigen::Vector2d Offsets() {
    EqualityBlock equalities = AddEqualities(&before_);
    const Eigen::Vector2d b = equalities.b;
    easing_.Ease(task_, &equalities);
    return b - equalities.b;
  }

  Easing easing_{2};
  int task_;
  Hierarchy rows_;
  Hierarchy before_;
};

TEST_F(EasingTest, IsPossibleOnlyWithLastYAndDuration) {
  EXPECT_FALSE(easing_.IsPossible());
  easing_.Advance(kDt, kLast);
  EXPECT_TRUE(easing_.IsPossible());
  easing_.set_duration(0);
  EXPECT_FALSE(easing_.IsPossible());
  easing_.set_duration(0.01);
  easing_.KeepFree();
  EXPECT_TRUE(easing_.is_on());
  EXPECT_TRUE(easing_.holds());
  easing_.End();
  EXPECT_FALSE(easing_.IsPossible());
  EXPECT_FALSE(easing_.is_on());
  EXPECT_FALSE(easing_.holds());
}

TEST_F(EasingTest, LastYMeetsNewEqualities) {
  easing_.Advance(kDt, kLast);
  easing_.BeginAtLast(task_, AddEqualities(&rows_));
  EXPECT_EQ(Offsets(), Eigen::Vector2d(4, -2));
  EXPECT_FALSE(easing_.holds());
  // A second call changes nothing.
  easing_.BeginAtLast(task_, AddEqualities(&rows_));
  EXPECT_EQ(Offsets(), Eigen::Vector2d(4, -2));
  // Half of the minimum-jerk curve has passed.
  for (int i = 0; i < 5; ++i) easing_.Advance(kDt, kLast);
  EXPECT_LT((Offsets() - Eigen::Vector2d(2, -1)).norm(), 1e-14);
  for (int i = 0; i < 5; ++i) easing_.Advance(kDt, kLast);
  EXPECT_FALSE(easing_.is_on());
  EXPECT_EQ(Offsets(), Eigen::Vector2d::Zero());
}

// The first row has a new target, the second row a larger weight, and the
// weight of the task is halved. Weight times residual at the last y stays the
// same.
TEST_F(EasingTest, KeepsWeightTimesResidualOfTunedEqualities) {
  const Eigen::Vector2d lacked(0.5, -0.25);
  easing_.Advance(kDt, kLast);
  easing_.Remember(task_, lacked, Eigen::Vector3d::Zero(), 1);
  EqualityBlock before = AddEqualities(&before_);
  before.b[0] = 2.5;
  before.weight[1] = 3;
  EqualityBlock now = AddEqualities(&rows_);
  now.weight[1] = 5;
  easing_.BeginAsBefore(task_, now, before, 2);
  // Residual without offset at the last y = recorded residual + earlier offset.
  const Eigen::Vector2d offsets_before(3.5 - 0.5, -2 + 0.25);
  const Eigen::Vector2d left =
      Eigen::Vector2d(4, -2) - (offsets_before + Offsets());
  EXPECT_NEAR(left[0] * 1, lacked[0] * 1 * 2, 1e-15);
  EXPECT_NEAR(left[1] * 5, lacked[1] * 3 * 2, 1e-15);
}

TEST_F(EasingTest, KeepResidualsAddsThemToOffsets) {
  easing_.Advance(kDt, kLast);
  easing_.Remember(task_, Eigen::Vector2d(0.5, -0.25), Eigen::Vector3d::Zero(),
                   1);
  easing_.KeepResiduals(task_, 2);
  EXPECT_EQ(Offsets(), Eigen::Vector2d(0.5, -0.25));
  easing_.KeepResiduals(task_, 2);  // A second call changes nothing.
  EXPECT_EQ(Offsets(), Eigen::Vector2d(0.5, -0.25));
}

TEST_F(EasingTest, KeepFreeHoldsYAndNothingElse) {
  const auto held = [&] {
    rows_.Clear(2);
    EqualityBlock rows = rows_.AddEqualities(1, 2);
    easing_.Hold(&rows);
    EXPECT_TRUE(rows_.B(1).isIdentity(0));
    return Eigen::Vector2d(-rows_.b(1));
  };
  easing_.Advance(kDt, kLast);
  easing_.KeepFree();
  EXPECT_EQ(held(), kLast);
  // y has moved away from its offset: KeepFree() adds the difference.
  easing_.Advance(kDt, 3 * kLast);
  const Eigen::Vector2d left = held();
  EXPECT_LT((left - kLast).norm(), 0.01 * kLast.norm());
  easing_.KeepFree();
  EXPECT_LT((held() - (left + 2 * kLast)).norm(), 1e-15);
  EXPECT_EQ(Offsets(), Eigen::Vector2d::Zero());
}

TEST_F(EasingTest, LastYIsInsideEasedLimits) {
  const auto limits = [&] {
    rows_.Clear(1);
    InequalityBlock rows = rows_.AddInequalities(0, 3);
    rows.C << 1, 0, 1, 0, 0, 1;
    rows.upper[0] = 0.5;  // The last y is 0.5 above.
    rows.lower[1] = 3;    // The last y is 2 below.
    rows.lower[2] = -5;
    rows.upper[2] = 5;
    return rows;
  };
  constexpr double kInf = std::numeric_limits<double>::infinity();
  easing_.Advance(kDt, kLast);
  for (int twice = 0; twice < 2; ++twice) {
    easing_.BeginInside(task_, 2, limits());
    InequalityBlock rows = limits();
    easing_.Ease(task_, 2, &rows);
    EXPECT_EQ(Eigen::Vector3d(rows.lower), Eigen::Vector3d(-kInf, 1, -5));
    EXPECT_EQ(Eigen::Vector3d(rows.upper), Eigen::Vector3d(1, kInf, 5));
  }
  // Limits that were violated before keep their violation.
  easing_.End();
  easing_.Advance(kDt, kLast);
  easing_.Remember(task_, Eigen::Vector2d::Zero(), Eigen::Vector3d(0.6, 3, 0),
                   2);
  easing_.BeginInside(task_, 2, limits());
  InequalityBlock rows = limits();
  easing_.Ease(task_, 2, &rows);
  EXPECT_NEAR(rows.upper[0], 0.7, 1e-15);
  EXPECT_NEAR(rows.lower[1], 2.5, 1e-15);
}

}  // namespace
}  // namespace poise
