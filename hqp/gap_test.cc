// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The gap of answers whose optimum is known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {
namespace {

// Level 0 has the targets y_0 = 0 and y_0 = 2, so that its optimum is y_0 = 1.
// Level 1 has the target y_0 = `target`. The answer is y_0 = 1 + off.
class TwoTargets {
 public:
  TwoTargets(double off, double target) : off_(off) {
    hierarchy_.Clear(2);
    EqualityBlock rows = hierarchy_.AddEqualities(0, 2);
    rows.B << 1, 1;
    rows.b << 0, -2;
    EqualityBlock below = hierarchy_.AddEqualities(1, 1);
    below.B << 1;
    below.b << -target;
    solution_.y << 1 + off;
    EvaluateLevel(hierarchy_, 0, &solution_);
    EvaluateLevel(hierarchy_, 1, &solution_);
  }

  // Sets the multipliers of level 1, and the trade-off p = (trade_off) if it is
  // not 0.
  void SetMultipliers(double first, double second, double trade_off) {
    solution_.levels[1].multipliers[0].equality << first, second;
    solution_.levels[1].traded_level = trade_off == 0 ? -1 : 0;
    solution_.levels[1].trade_off << trade_off;
  }

  double gap() {
    (void)certifier_.Certify(hierarchy_, solution_);
    return certifier_.gap(1);
  }
  double excess(double target) const {
    return (std::pow(1 + off_ - target, 2) - std::pow(1 - target, 2)) / 2;
  }

 private:
  const double off_;
  const std::vector<LevelCapacity> capacity_{{2, 0}, {1, 0}};
  Hierarchy hierarchy_{1, capacity_};
  Solution solution_{1, capacity_};
  Certifier certifier_{1, capacity_};
};

// Rounding of these small numbers: about 10 eps of terms up to 50, times a
// radius of less than 50.
constexpr double kRounding = 5e-12;

// The multipliers of level 1, half of its gradient each, are along p = target -
// y_0.
TEST(GapByHand, IsLinearInTheErrorOfALevelAbove) {
  for (const double off : {-1e-3, -1e-6, -1e-9}) {
    SCOPED_TRACE(off);
    const double target = 3, multiplier = (target - (1 + off)) / 2;
    TwoTargets answer(off, target);
    answer.SetMultipliers(multiplier, multiplier, 0);
    // Without a trade-off, the gap is a root, see docs/hqp-gap.md.
    const double without = answer.gap();
    EXPECT_GE(without, answer.excess(target));
    answer.SetMultipliers(multiplier, multiplier, multiplier);
    EXPECT_GE(answer.gap(), answer.excess(target));
    // Twice |g_0 p|, with g_0 = 2 off and p up to 1.0005.
    EXPECT_LE(answer.gap(), 4.01 * std::abs(off) + kRounding);
    EXPECT_LE(answer.gap(), without);
    // A wrong direction is of no use, and does no harm.
    answer.SetMultipliers(multiplier, multiplier, -multiplier);
    EXPECT_GE(answer.gap(), answer.excess(target));
  }
}

// Multipliers along the residuals, f (1 + off, off - 1), have the sum 2 f off,
// which is the gradient of level 1. If f is positive, level 1 costs less at y
// than at its optimum, where level 0 costs less.
TEST(GapByHand, IsSmallForPositiveMultiplesOfTheResiduals) {
  for (const double off : {1e-3, -1e-4}) {
    for (const double f : {10., -10.}) {
      SCOPED_TRACE(testing::Message() << off << ", " << f);
      const double target = 1 + off + 2 * f * off;
      TwoTargets answer(off, target);
      answer.SetMultipliers(f * (1 + off), f * (off - 1), 0);
      EXPECT_GE(answer.gap(), answer.excess(target));
      if (f > 0) {
        EXPECT_LE(answer.gap(), kRounding);
      } else {
        // off^2 (-4 f - 1) / 2.
        EXPECT_GE(answer.excess(target), 19 * off * off);
      }
    }
  }
}

// Level 0 has the bounds y_0 <= 0 and y_0 >= 2, so that its optimum is y_0 = 1
// with a slack of 1 at both. Level 1 has the target y_0 = 3. The answer is
// y_0 = 1 + off: level 0 costs off^2 too much, and level 1 off^2 / 2 - 2 off,
// since its multipliers act on the slacks.
TEST(GapByHand, CoversTheSlacksOfBoundsThatContradictEachOther) {
  for (const double off : {-1e-2, -1e-4, -1e-6}) {
    SCOPED_TRACE(off);
    const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}};
    Hierarchy hierarchy(1, capacity);
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C << 1, 1;
    bounds.lower << -std::numeric_limits<double>::infinity(), 2;
    bounds.upper << 0, std::numeric_limits<double>::infinity();
    EqualityBlock target = hierarchy.AddEqualities(1, 1);
    target.B << 1;
    target.b << -3;
    Solution solution(1, capacity);
    solution.y << 1 + off;
    EvaluateLevel(hierarchy, 0, &solution);
    EvaluateLevel(hierarchy, 1, &solution);
    solution.levels[1].multipliers[0].inequality.setConstant((2 - off) / 2);
    Certifier certifier(1, capacity);
    const Certificate certificate = certifier.Certify(hierarchy, solution);
    EXPECT_EQ(certificate.complementarity, 0);
    EXPECT_GE(certifier.gap(0), off * off);
    EXPECT_GE(certifier.gap(1), off * off / 2 - 2 * off);
  }
}

// Level 1 minimises |B d + r|^2 / 2 with B = (1, 600; 0, 800) and d = y - (8,
// 0). At d = 0 its gradient B' r is (1, 0). With y_1 <= 1 / 2048, the optimum
// is y_1 = 1 / 2048 and d_0 = -1 - 600 y_1 = -1.293, where the multiplier of
// the bound is 600 - 640000 y_1 = 287.5. So level 2, with multipliers B p for
// p = (0, -1), costs 287.5 - 16 / 2 |d|^2 less there: much more than the
// gradient along p, which is 0.
class BoundedTrade {
 public:
  // The bound is a row of level `bound_level`, 0 or 1. If it `is_fixed`, level
  // 0 has the target y_1 = 0 instead.
  explicit BoundedTrade(int bound_level, bool is_fixed = false) {
    hierarchy_.Clear(3);
    if (is_fixed) hierarchy_.AddEqualities(0, 1).SetSingle(0, 1, 1);
    const double steep =
        bound_level == 0 ? 1 : 0x1p40;  // As good as a hard bound.
    InequalityBlock bound = hierarchy_.AddInequalities(bound_level, 1);
    bound.C << 0, steep;
    bound.lower << -steep;
    bound.upper << (is_fixed ? steep : steep / 2048);
    EqualityBlock rows = hierarchy_.AddEqualities(1, 2);
    rows.B << 1, 600, 0, 800;
    rows.b << 1 - 8, -0.75;
    EqualityBlock below = hierarchy_.AddEqualities(2, 2);
    below.B.setIdentity();
    below.b << 600. / 16 - 8, 1e6 / 16;
    below.weight << 16, 16;
    solution_.y << 8, 0;
    for (int level = 0; level < 3; ++level) {
      EvaluateLevel(hierarchy_, level, &solution_);
    }
    solution_.levels[2].multipliers[1].equality << -600, -800;
    solution_.levels[2].traded_level = 1;
    solution_.levels[2].trade_off << 0, -1;
  }

  double gap() {
    (void)certifier_.Certify(hierarchy_, solution_);
    return certifier_.gap(2);
  }

 private:
  const std::vector<LevelCapacity> capacity_{{1, 1}, {2, 1}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
  Solution solution_{2, capacity_};
  Certifier certifier_{2, capacity_};
};

TEST(GapByHand, CoversATradeThatABoundLimits) {
  const double excess = 287.5 - 8 * 1.293 * 1.293;
  EXPECT_GE(BoundedTrade(0).gap(), excess);
  EXPECT_GE(BoundedTrade(1).gap(), excess);
}

// With y_1 = 0, the optimum is d_0 = -1, where the multiplier of this row
// is 600. At y it is zero, so that only the change of the row along p shows
// that p is of no use.
TEST(GapByHand, CoversATradeAgainstARowAbove) {
  EXPECT_GE(BoundedTrade(0, true).gap(), 600 - 8);
}

// Level 0 has the target y_1 = 0 and the bound y_0 <= 8 + 1e-5. Level 1
// minimises |B y + b|^2 / 2 with B as above. y_1 = 1e-6 misses level 0, and
// y_0 = 8 is best for it. At the optimum, y_1 = 0 has its best y_0 600e-6
// higher, of which the bound allows 10e-6. Level 2 has the gradient (1, 600),
// and costs 590e-6 less there. The numbers 1e-6 and 1e-5 are no tolerances but
// data, far larger than rounding.
TEST(GapByHand, CoversATradeAtAYThatMissesALevelAbove) {
  const double off = 1e-6, distance = 10 * off, weight = 16;
  const std::vector<LevelCapacity> capacity{{1, 1}, {2, 0}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  hierarchy.Clear(3);
  hierarchy.AddEqualities(0, 1).SetSingle(0, 1, 1);
  InequalityBlock bound = hierarchy.AddInequalities(0, 1);
  bound.C << 1, 0;
  bound.lower << -INFINITY;
  bound.upper << 8 + distance;
  EqualityBlock rows = hierarchy.AddEqualities(1, 2);
  rows.B << 1, 600, 0, 800;
  rows.b << -8 - 600 * off, -0.75;
  EqualityBlock below = hierarchy.AddEqualities(2, 2);
  below.B.setIdentity();
  below.b << 1 / weight - 8, 600 / weight - off;
  below.weight << weight, weight;
  Solution solution(2, capacity);
  solution.y << 8, off;
  for (int level = 0; level < 3; ++level) {
    EvaluateLevel(hierarchy, level, &solution);
  }
  solution.levels[1].multipliers[0].equality << 600 - 640000 * off;
  solution.levels[2].multipliers[1].equality << -1, 0;
  solution.levels[2].traded_level = 1;
  solution.levels[2].trade_off << -1, 0;
  Certifier certifier(2, capacity);
  (void)certifier.Certify(hierarchy, solution);
  const double d[] = {distance, -off};
  EXPECT_GE(certifier.gap(2),
            -d[0] - 600 * d[1] - weight / 2 * (d[0] * d[0] + d[1] * d[1]));
}

// Level 0 has the target y_0 = 0, level 1 y_0 = 1. y_0 = off misses level 0, so
// that level 1 costs less than its optimum. Level 2 has the target off + 1000
// (off - 1), and its multiplier on level 1 is 1000 times the residual there.
// With y_0 = 0, level 2 costs 1000 off less.
TEST(GapByHand, CoversALevelAboveThatCostsLessThanItsOptimum) {
  const double off = 1e-6, f = 1000;
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  hierarchy.Clear(3);
  const double targets[] = {0, 1, off + f * (off - 1)};
  for (int level = 0; level < 3; ++level) {
    EqualityBlock row = hierarchy.AddEqualities(level, 1);
    row.B << 1;
    row.b << -targets[level];
  }
  Solution solution(1, capacity);
  solution.y << off;
  for (int level = 0; level < 3; ++level) {
    EvaluateLevel(hierarchy, level, &solution);
  }
  solution.levels[1].multipliers[0].equality << 1 - off;
  solution.levels[2].multipliers[1].equality << f * (off - 1);
  Certifier certifier(1, capacity);
  (void)certifier.Certify(hierarchy, solution);
  EXPECT_GE(certifier.gap(2),
            (std::pow(off - targets[2], 2) - std::pow(targets[2], 2)) / 2);
}

// Level 0 sets all variables but the last one, x = 0, to 1. Level 1 has the
// rows -e x <= 0 and c y + e x <= u. The sum c y in double loses `lost`, so
// that the second row is inside its bound by 3/4 of this, while it exceeds its
// bound by 1/4 in exact arithmetic. At the optimum of level 1, both rows have
// half of this slack. Level 2 has the target x = -1 and the multiplier 1 / e on
// the first row.
TEST(GapByHand, CoversASlackThatRoundingHides) {
  const int fixed = 400;
  const double e = 0x1p-24;
  const std::vector<LevelCapacity> capacity{{fixed, 0}, {0, 2}, {1, 0}};
  Hierarchy hierarchy(fixed + 1, capacity);
  hierarchy.Clear(3);
  EqualityBlock fix = hierarchy.AddEqualities(0, fixed);
  InequalityBlock bounds = hierarchy.AddInequalities(1, 2);
  for (int j = 0; j < fixed; ++j) fix.SetSingle(j, j, 1);
  fix.b.setConstant(-1);
  // Each of the four sums of RowSums begins with 1.001 or -1.001, and all
  // further terms are less than half of its last digit.
  const double small = 0.499 * std::numeric_limits<double>::epsilon();
  const double lost = (fixed - 4) * small;
  bounds.C.row(1).setConstant(small);
  bounds.C.row(1).head(4) << 1.001, -1.001, 1.001, -1.001;
  bounds.C(0, fixed) = -e;
  bounds.C(1, fixed) = e;
  bounds.upper << 0, 0.75 * lost;
  EqualityBlock target = hierarchy.AddEqualities(2, 1);
  target.SetSingle(0, fixed, 1);
  target.b << 1;
  hierarchy.FindSpans();
  Solution solution(fixed + 1, capacity);
  solution.y.setOnes();
  solution.y[fixed] = 0;
  for (int level = 0; level < 3; ++level) {
    EvaluateLevel(hierarchy, level, &solution);
  }
  solution.levels[2].multipliers[1].inequality << 1 / e, 0;
  Certifier certifier(fixed + 1, capacity);
  EXPECT_LE(certifier.Certify(hierarchy, solution).worst(),
            Certifier::kCertified);
  ASSERT_EQ(solution.levels[1].cost, 0);
  const double move = 0.25 * lost / (2 * e);
  EXPECT_GE(certifier.gap(2), move - move * move / 2);
}

// Multipliers of 1e12 cancel. In double, the rounding of their sum would be 6
// eps times 2e12 and a radius of 8, 0.02, and that of the level above, which is
// met, 0.004.
TEST(GapByHand, IsSharpForLargeMultipliersThatCancel) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  hierarchy.Clear(2);
  EqualityBlock rows = hierarchy.AddEqualities(0, 2);
  rows.B << 1, 1;
  rows.b << -1, -1;
  EqualityBlock below = hierarchy.AddEqualities(1, 1);
  below.B << 1;
  below.b << -3;
  Solution solution(1, capacity);
  solution.y << 1;
  EvaluateLevel(hierarchy, 1, &solution);
  solution.levels[1].multipliers[0].equality << 1e12 + 2, -1e12;
  Certifier certifier(1, capacity);
  (void)certifier.Certify(hierarchy, solution);
  // With the eps of long double, 1.1e-19 on most machines, the former is 14 eps
  // times 2e12 times 8, 2.4e-5, and the latter 5e-6.
  EXPECT_LE(certifier.gap(1),
            4e-5 * std::numeric_limits<long double>::epsilon() / 1.1e-19L);
  // With a level above that is off, level 1 costs 2e-9 more than its optimum.
  solution.y << 1 - 1e-9;
  EvaluateLevel(hierarchy, 0, &solution);
  EvaluateLevel(hierarchy, 1, &solution);
  (void)certifier.Certify(hierarchy, solution);
  EXPECT_GE(certifier.gap(1), 2e-9);
}

// Level 0 bounds y by (a, e) y <= u_1 and (-a, e) y <= u_2, both met to
// rounding of a. Level 1 has the target y_1 + 1, which these bounds, with
// multipliers 1 / (2 e), allow to be met better by the rounding divided by e.
TEST(GapByHand, CoversTheRoundingOfBoundsWithLargeMultipliers) {
  const double e = 0x1p-33, a = 0.5807597826234586;
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}};
  int above_rounding = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Hierarchy hierarchy(2, capacity);
    hierarchy.Clear(2);
    Solution solution(2, capacity);
    solution.y << std::sin(i + 1), -std::cos(i + 1);
    const Eigen::VectorXd& y = solution.y;
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C << a, e, -a, e;
    bounds.lower.setConstant(-INFINITY);
    bounds.upper << a * y[0] + e * y[1], -a * y[0] + e * y[1];
    EqualityBlock target = hierarchy.AddEqualities(1, 1);
    target.B << 0, 1;
    target.b << -(y[1] + 1);
    for (int level = 0; level < 2; ++level) {
      EvaluateLevel(hierarchy, level, &solution);
    }
    solution.levels[1].multipliers[0].inequality.setConstant(1 / (2 * e));
    Certifier certifier(2, capacity);
    (void)certifier.Certify(hierarchy, solution);
    // The bounds meet where y_1 = (u_1 + u_2) / (2 e).
    const long double highest =
        (static_cast<long double>(bounds.upper[0]) + bounds.upper[1]) / (2 * e);
    const long double move = std::min(highest - y[1], 1.0L);
    const auto excess = static_cast<double>(move - move * move / 2);
    EXPECT_GE(certifier.gap(1), excess);
    above_rounding += excess > 1e-9;
  }
  EXPECT_GE(above_rounding, 10);
}

}  // namespace
}  // namespace poise
