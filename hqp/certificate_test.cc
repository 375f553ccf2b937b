// Tests that the certificate detects errors: each test changes one number of an
// optimal answer.
#include "poise/hqp/certificate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace poise {
namespace {

constexpr double kRounding = 1e-15;  // For sums of small whole numbers.

// Level 0: y0 <= 1, 3 <= y1 <= 8 and y0 + y1 <= 2. Level 1: y = (5, 0) with
// weights 2 and 1. All rows of level 0 are met where y1 >= 3 and y0 <= 2 - y1.
// The optimum of level 1 among these y is (-1, 3).
class CertificateTest : public testing::Test {
 protected:
  CertificateTest() {
    InequalityBlock rows = hierarchy_.AddInequalities(0, 3);
    rows.C << 1, 0, 0, 1, 1, 1;
    rows.upper << 1, 8, 2;
    rows.lower[1] = 3;
    EqualityBlock target = hierarchy_.AddEqualities(1, 2);
    target.B.setIdentity();
    target.b << -5, 0;
    target.weight << 2, 1;
    solution_.y << -1, 3;
    for (int level = 0; level < 2; ++level) {
      EvaluateLevel(hierarchy_, level, &solution_);
    }
    // g = (2 * -6, 3) + mu_1 (0, 1) + mu_2 (1, 1) = 0.
    solution_.levels[1].multipliers[0].inequality << 0, -15, 12;
  }

  Certificate Certify() { return certifier_.Certify(hierarchy_, solution_); }

  const std::vector<LevelCapacity> capacity_{{0, 3}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
  Solution solution_{2, capacity_};
  Certifier certifier_{2, capacity_};
};

TEST_F(CertificateTest, AcceptsTheOptimum) {
  EXPECT_LE(Certify().worst(), kRounding);
  EXPECT_NEAR(solution_.levels[1].cost, 40.5, kRounding);
}

TEST_F(CertificateTest, FindsAWrongMultiplier) {
  solution_.levels[1].multipliers[0].inequality[2] += 1e-6;
  // The gradient is relative to |B|' W (|B| |y| + |b|) + |C|' |mu|. For y0 this
  // is 12 + 12, for y1 it is 3 + 15 + 12 plus the error of the multiplier.
  EXPECT_NEAR(Certify().stationarity, 1e-6 / (30 + 1e-6), kRounding);
  EXPECT_LE(Certify().feasibility, kRounding);
  EXPECT_LE(Certify().complementarity, kRounding);
}

TEST_F(CertificateTest, FindsAMultiplierOfTheWrongSign) {
  hierarchy_.Clear(2);
  InequalityBlock rows = hierarchy_.AddInequalities(0, 3);
  // The last row is negated, but its multiplier is not.
  rows.C << 1, 0, 0, 1, -1, -1;
  rows.upper << 1, 3, 8;
  rows.lower[2] = -8;
  EqualityBlock target = hierarchy_.AddEqualities(1, 2);
  target.B.setIdentity();
  target.b << -5, 0;
  target.weight << 2, 1;
  // Row 1 is at its upper bound with a negative multiplier; row 2 has a gap.
  EXPECT_NEAR(Certify().complementarity, 15. / 30, kRounding);
}

TEST_F(CertificateTest, FindsAMultiplierOnARowWithAGap) {
  solution_.levels[1].multipliers[0].inequality[0] = 1e-3;
  EXPECT_NEAR(Certify().complementarity, 1e-3 / 30, kRounding);
}

TEST_F(CertificateTest, FindsAWrongResidual) {
  solution_.levels[1].equality_residual[0] += 6e-3;
  // Relative to |y0| + |b0| = 6.
  EXPECT_NEAR(Certify().feasibility, 1e-3, kRounding);
}

TEST_F(CertificateTest, FindsAWrongSlack) {
  solution_.levels[0].slack[2] += 6e-3;
  // Relative to |y0| + |y1| + |upper| = 1 + 3 + 2.
  EXPECT_NEAR(Certify().feasibility, 1e-3, kRounding);
}

TEST_F(CertificateTest, FindsAWrongCost) {
  solution_.levels[1].cost -= 1e-3;
  // Relative to c = (2 (1 + 5)^2 + 3^2) / 2 = 40.5, plus 1e-9 of the cost of
  // the magnitudes of the terms, which is also 40.5.
  EXPECT_NEAR(Certify().priority, 1e-3 / (40.5 * (1 + 1e-9)), kRounding);
}

TEST_F(CertificateTest, FindsACostOfALevelThatIsMet) {
  solution_.levels[0].cost = 1e-9;
  // The cost at y is zero. So the error is relative to 1e-9 of the cost of the
  // magnitudes, ((1 + 1)^2 + (3 + 3)^2 + (1 + 3 + 2)^2) / 2 = 38.
  EXPECT_NEAR(Certify().priority, 1. / 38, kRounding);
}

TEST_F(CertificateTest, FindsNaN) {
  solution_.levels[1].multipliers[0].inequality[0] = NAN;
  EXPECT_EQ(Certify().worst(), INFINITY);
}

TEST_F(CertificateTest, FindsAWrongY) {
  solution_.y[0] += 1e-3;
  for (int level = 0; level < 2; ++level) {
    EvaluateLevel(hierarchy_, level, &solution_);
  }
  // The gradient is relative to about 30, see FindsAWrongMultiplier; 38 leaves
  // a margin.
  EXPECT_GE(Certify().worst(), 1e-3 / 38);
}

TEST_F(CertificateTest, CertifiesSolvedLevelsOnly) {
  solution_.levels[1].cost = 0;
  solution_.failed_level = 1;
  EXPECT_LE(Certify().worst(), kRounding);
}

TEST(Certificate, AllowsAnyMultiplierOnAViolatedRow) {
  // y <= -1 and y >= 1 are both violated by 1 at y = 0. The gradient of the
  // target y = 2 on level 1 is cancelled by any two multipliers of sum 2.
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock rows = hierarchy.AddInequalities(0, 2);
  rows.C << 1, 1;
  rows.upper[0] = -1;
  rows.lower[1] = 1;
  EqualityBlock target = hierarchy.AddEqualities(1, 1);
  target.B << 1;
  target.b << -2;
  Solution solution(1, capacity);
  EvaluateLevel(hierarchy, 0, &solution);
  EvaluateLevel(hierarchy, 1, &solution);
  EXPECT_EQ(solution.levels[0].cost, 1);
  Certifier certifier(1, capacity);
  for (const double share : {-1., 0., 3.}) {
    solution.levels[1].multipliers[0].inequality << 2 + share, -share;
    EXPECT_LE(certifier.Certify(hierarchy, solution).worst(), kRounding);
  }
}

TEST(Certificate, AllowsAnyMultiplierBetweenEqualBounds) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {1, 0}};
  for (const double target : {-3., 3.}) {
    Hierarchy hierarchy(1, capacity);
    InequalityBlock row = hierarchy.AddInequalities(0, 1);
    row.C << 1;
    row.lower << 1;
    row.upper << 1;
    EqualityBlock below = hierarchy.AddEqualities(1, 1);
    below.B << 1;
    below.b << -target;
    Solution solution(1, capacity);
    solution.y << 1;
    EvaluateLevel(hierarchy, 0, &solution);
    EvaluateLevel(hierarchy, 1, &solution);
    solution.levels[1].multipliers[0].inequality << target - 1;
    EXPECT_LE(Certifier(1, capacity).Certify(hierarchy, solution).worst(),
              kRounding);
  }
}

// y = (1, 2) meets y0 <= 1, as the span says, and violates y0 + y1 <= 1.
TEST(Certifier, RejectsARowThatIsNotZeroOutsideItsSpan) {
  for (const double outside : {0., 1., std::nan(""), 1e-300}) {
    SCOPED_TRACE(outside);
    const std::vector<LevelCapacity> capacity{{1, 1}};
    Hierarchy hierarchy(2, capacity);
    InequalityBlock limit = hierarchy.AddInequalities(0, 1);
    limit.SetSingle(0, 0, 1);
    limit.C(0, 1) = outside;
    limit.upper << 1;
    EqualityBlock target = hierarchy.AddEqualities(0, 1);
    target.SetSingle(0, 1, 1);
    target.B(0, 0) = outside;
    target.b << -2;
    Solution solution(2, capacity);
    solution.y << 1, 2;
    const double worst =
        Certifier(2, capacity).Certify(hierarchy, solution).worst();
    if (outside == 0) {
      EXPECT_EQ(worst, 0);
    } else {
      EXPECT_GT(worst, Certifier::kCertified);
    }
  }
}

// Above 1.3e154 the square of a row overflows. Its margin would be infinite,
// and no multiplier on it wrong.
TEST(Certifier, CertifiesNoRowWhoseSquareOverflows) {
  const std::vector<LevelCapacity> capacity = {{0, 1}, {1, 0}};
  for (const double size : {1e150, 1e155}) {
    Hierarchy hierarchy(1, capacity);
    InequalityBlock bound = hierarchy.AddInequalities(0, 1);
    bound.C << size;
    bound.upper << size;
    EqualityBlock target = hierarchy.AddEqualities(1, 1);
    target.B << 1;
    target.b << -0.5;
    Solution solution(1, capacity);
    solution.y << 0.25;  // The optimum is 0.5.
    for (const int level : {0, 1}) EvaluateLevel(hierarchy, level, &solution);
    solution.levels[1].multipliers[0].inequality[0] = 0.25 / size;
    Certifier certifier(1, capacity);
    certifier.Certify(hierarchy, &solution);
    EXPECT_GT(solution.certificate.worst(), 0.1) << size;
  }
}

TEST(Certifier, CertifiesNoEqualityWhoseSquareOverflows) {
  const std::vector<LevelCapacity> capacity = {{1, 0}};
  for (const double size : {1e150, 1e155}) {
    Hierarchy hierarchy(1, capacity);
    EqualityBlock target = hierarchy.AddEqualities(0, 1);
    target.B << size;
    target.b << -size;
    Solution solution(1, capacity);
    solution.y << 1;
    EvaluateLevel(hierarchy, 0, &solution);
    Certifier certifier(1, capacity);
    certifier.Certify(hierarchy, &solution);
    EXPECT_EQ(solution.certificate.worst(), size < 1e154 ? 0 : INFINITY);
  }
}

// A level that is not certified bounds nothing, so that the largest gap is that
// of the levels above it.
TEST(Certifier, HasNoGapOfALevelThatFails) {
  const std::vector<LevelCapacity> capacity = {{1, 0}, {1, 0}};
  Hierarchy hierarchy(2, capacity);
  hierarchy.AddEqualities(0, 1).B << 1, 0;
  EqualityBlock second = hierarchy.AddEqualities(1, 1);
  second.B << 0, 1;
  second.b << -1;
  Solution solution(2, capacity);
  for (const int level : {0, 1}) EvaluateLevel(hierarchy, level, &solution);
  Certifier certifier(2, capacity);
  certifier.Truncate(hierarchy, &solution);
  EXPECT_EQ(solution.failed_level, 1);
  EXPECT_NEAR(certifier.gap(1), 0.5,
              1e-14);  // The whole cost, and its rounding.
  // Level 0 is met exactly. The gap of level 1 is all of its cost.
  EXPECT_LT(solution.certificate.relative_gap, 1e-9);
}

}  // namespace
}  // namespace poise
