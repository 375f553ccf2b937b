// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/ramp.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

const Eigen::Vector2d kLast(1, -2);

// A hierarchy of rows that the last y does not all meet, each eased.
class Eased {
 public:
  explicit Eased(const Ramp& ramp) : rows_(2, {{2, 3}, {2, 0}}) {
    rows_.Clear(2);
    EqualityBlock equal = rows_.AddEqualities(0, 2);
    equal.B << 1, 0, 1, 1;
    equal.b << 3, -1;  // Off by 4 and -2.
    InequalityBlock unequal = rows_.AddInequalities(0, 3);
    unequal.C << 1, 0, 1, 0, 0, 1;
    unequal.upper[0] = 0.5;  // Half too large.
    unequal.lower[1] = 3;    // Two too small.
    unequal.lower[2] = -5;
    unequal.upper[2] = 5;
    ramp.Ease(&equal);
    ramp.Ease(&unequal);
    EqualityBlock held = rows_.AddEqualities(1, 2);
    ramp.Hold(&held);
  }

  // The part that is kept of what the first row is off by.
  double kept() const { return (3 - rows_.b(0)[0]) / 4; }

  void ExpectAllKeepTheSame() const {
    const double k = kept();
    EXPECT_NEAR(rows_.b(0)[1], -1 + 2 * k, 1e-15);
    EXPECT_NEAR(rows_.upper(0)[0], 0.5 + 0.5 * k, 1e-15);
    EXPECT_NEAR(rows_.lower(0)[1], 3 - 2 * k, 1e-15);
    EXPECT_EQ(rows_.lower(0)[2], -5);
    EXPECT_EQ(rows_.upper(0)[2], 5);
    EXPECT_TRUE(rows_.B(1).isIdentity(0));
    EXPECT_LT((rows_.b(1) + k * kLast).norm(), 1e-15);
  }

 private:
  Hierarchy rows_;
};

// Of ten ticks: what all together have kept falls along a curve of least jerk.
TEST(Ramp, KeepsOfEveryRowAPartThatFallsToNothing) {
  Ramp ramp(2);
  ramp.set_duration(0.01);
  ramp.Begin();
  EXPECT_FALSE(ramp.is_on());  // There is nothing yet to begin at.
  ramp.Advance(1e-3, kLast);
  EXPECT_FALSE(ramp.is_on());
  for (const int ticks : {4, 10}) {  // It begins anew before it is over.
    ramp.Begin();
    double product = 1;
    for (int i = 1; i <= ticks; ++i) {
      SCOPED_TRACE(i);
      ASSERT_EQ(ramp.is_on(), i < 10);
      if (ramp.is_on()) Eased(ramp).ExpectAllKeepTheSame();
      product *= ramp.is_on() ? Eased(ramp).kept() : 0;
      const double s = 0.1 * i;
      EXPECT_NEAR(product, 1 - s * s * s * (10 - 15 * s + 6 * s * s), 1e-12);
      ramp.Advance(1e-3, kLast);
    }
  }
  EXPECT_FALSE(ramp.is_on());
}

TEST(Ramp, EasesNothingAfterItsEndOrWithoutADuration) {
  Ramp ramp(2);
  ramp.Advance(1e-3, kLast);
  ramp.Begin();
  EXPECT_FALSE(ramp.is_on());
  ramp.set_duration(0.01);
  ramp.Begin();
  EXPECT_TRUE(ramp.is_on());
  ramp.End();
  EXPECT_FALSE(ramp.is_on());
  ramp.Begin();
  EXPECT_FALSE(ramp.is_on());  // What came last is not known.
}

}  // namespace
}  // namespace poise
