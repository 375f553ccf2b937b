// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "poise/hqp/certificate.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Scale of the gradient: the residual of y_0 is the sum of the terms 3 and -3.
constexpr double kSize = 6;

// Level 0 bounds y_1; level 1 has the target y = (3, target). The optimum and
// its multiplier are known in closed form. Each test changes one number of that
// answer.
class CertifierByHandTest : public testing::Test {
 protected:
  CertifierByHandTest() { Bound(0, 1, 2); }

  void Bound(double lower, double upper, double target) {
    hierarchy_.Clear(2);
    InequalityBlock bound = hierarchy_.AddInequalities(0, 1);
    bound.C << 0, 1;
    bound.lower << lower;
    bound.upper << upper;
    EqualityBlock desired = hierarchy_.AddEqualities(1, 2);
    desired.B.setIdentity();
    desired.b << -3, -target;
    const double y = std::min(std::max(target, lower), upper);
    Answer(y, y - target, target - y);
  }

  // Sets the answer y = (3, y), with this residual of y_1 and this multiplier
  // of the bound.
  void Answer(double y, double residual, double multiplier) {
    solution_.Reset();
    solution_.y << 3, y;
    solution_.levels[1].equality_residual << 0, residual;
    solution_.levels[1].cost = residual * residual / 2;
    solution_.levels[1].multipliers[0].inequality << multiplier;
  }

  Certificate Certify() { return certifier_.Certify(hierarchy_, solution_); }

  const std::vector<LevelCapacity> capacity_{{0, 1}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
  Solution solution_{2, capacity_};
  Certifier certifier_{2, capacity_};
};

// y_1 = 1 + excess has the cost (1 - excess)^2 / 2 with the target 2. The bound
// 1 permits (1 - 0)^2 / 2, and the target alone 0.
TEST_F(CertifierByHandTest, BoundsTheMissingCost) {
  for (const double below : {1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(below);
    // Inside the bound, with the multiplier that makes the sum zero.
    Answer(1 - below, -1 - below, 1 + below);
    (void)Certify();
    const double lacks = below + below * below / 2;
    // The bound is first-order: twice the second-order term, and the rounding
    // of the gradient, 6.5 eps of terms of 7.3 times a radius of 13.
    EXPECT_GE(certifier_.gap(1), lacks);
    EXPECT_LE(certifier_.gap(1), lacks + below * below + 1.5e-13);
    // Without a multiplier the gradient is 1, and y may move by 2 |y|.
    Answer(1 - below, -1 - below, 0);
    (void)Certify();
    EXPECT_GE(certifier_.gap(1), lacks);
    // The whole cost, with its rounding of a few eps.
    EXPECT_LE(certifier_.gap(1), solution_.levels[1].cost * (1 + 1e-13));
  }
}

TEST_F(CertifierByHandTest, HasNoGapForLevelsThatItDoesNotJudge) {
  Answer(1 - 1e-3, -1 - 1e-3, 0);
  certifier_.Truncate(hierarchy_, &solution_);
  EXPECT_EQ(solution_.failed_level, 1);
  EXPECT_LT(certifier_.gap(0), 1e-29);  // Rounding of the cost 0.
  EXPECT_GT(certifier_.gap(1), 1e-3);   // The failed level is judged.
  (void)Certify();
  EXPECT_EQ(certifier_.gap(1), kInfinity);
}

TEST_F(CertifierByHandTest, AcceptsTheOptimum) {
  EXPECT_EQ(Certify().worst(), 0);  // At the upper bound.
  Bound(0, 1, -2);                  // At the lower bound.
  EXPECT_EQ(Certify().worst(), 0);
  Bound(0, 1, 0.5);  // Inside both bounds.
  EXPECT_EQ(Certify().worst(), 0);
  Bound(1, 1, -2);  // At both bounds: the multiplier may have either sign.
  EXPECT_EQ(Certify().worst(), 0);
  Bound(1, 1, 5);
  EXPECT_EQ(Certify().worst(), 0);
}

TEST_F(CertifierByHandTest, FindsANonzeroGradient) {
  solution_.levels[1].multipliers[0].inequality << 0.5;
  EXPECT_EQ(Certify().stationarity, (1 - 0.5) / kSize);
  EXPECT_EQ(Certify().worst(), (1 - 0.5) / kSize);
}

TEST_F(CertifierByHandTest, FindsAMultiplierOfTheWrongSign) {
  solution_.levels[1].multipliers[0].inequality << -1;
  EXPECT_EQ(Certify().stationarity, 2 / kSize);
  EXPECT_EQ(Certify().complementarity, 1 / kSize);
  Bound(0, 1, -2);
  solution_.levels[1].multipliers[0].inequality << 2;
  EXPECT_EQ(Certify().complementarity, 2 / kSize);
}

TEST_F(CertifierByHandTest, FindsAMultiplierAcrossAGap) {
  Answer(0.5, -1.5, 1.5);
  const Certificate certificate = Certify();
  EXPECT_EQ(certificate.stationarity, 0);
  EXPECT_EQ(certificate.complementarity, 1.5 / kSize);
}

// An equality of weight 0 has no effect on its level, so it must not hold back
// a level below: y = 1 is optimal, not 0.
TEST(CertifierWeightTest, FindsAMultiplierOnAnEqualityOfWeightZero) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  hierarchy.Clear(2);
  EqualityBlock ignored = hierarchy.AddEqualities(0, 1);
  ignored.B << 1;
  ignored.weight << 0;
  EqualityBlock desired = hierarchy.AddEqualities(1, 1);
  desired.B << 1;
  desired.b << -1;
  Solution solution(1, capacity);
  solution.Reset();
  EvaluateLevel(hierarchy, 0, &solution);
  EvaluateLevel(hierarchy, 1, &solution);
  solution.levels[1].multipliers[0].equality << 1;
  const Certificate certificate =
      Certifier(1, capacity).Certify(hierarchy, solution);
  EXPECT_EQ(certificate.stationarity, 0);
  EXPECT_EQ(certificate.complementarity, 0.5);  // 1 of a gradient 1 + 1.
  ignored.weight << 1;                          // The equality holds y back.
  EXPECT_EQ(Certifier(1, capacity).Certify(hierarchy, solution).worst(), 0);
}

TEST_F(CertifierByHandTest, FindsAWrongResidualCostOrSlack) {
  solution_.levels[1].equality_residual[1] = -0.5;
  EXPECT_GT(Certify().feasibility, 0.01);
  Bound(0, 1, 2);
  solution_.levels[0].slack << 0.5;
  EXPECT_GT(Certify().feasibility, 0.01);
  Bound(0, 1, 2);
  solution_.levels[1].cost = 0.25;
  EXPECT_GT(Certify().priority, 0.01);
  EXPECT_EQ(Certify().feasibility, 0);
}

TEST_F(CertifierByHandTest, CertifiesTheLevelsAboveTheFailedOne) {
  solution_.levels[1].multipliers[0].inequality << -1;
  solution_.failed_level = 1;
  EXPECT_EQ(Certify().worst(), 0);
  solution_.levels[0].slack << 0.5;
  EXPECT_GT(Certify().worst(), 0);
  solution_.failed_level = 0;
  EXPECT_EQ(Certify().worst(), 0);
}

TEST_F(CertifierByHandTest, IsInfiniteIfAnyNumberIsNan) {
  solution_.levels[1].multipliers[0].inequality << kNan;
  EXPECT_EQ(Certify().worst(), kInfinity);
  Bound(0, 1, 2);
  solution_.y[1] = kNan;
  EXPECT_EQ(Certify().worst(), kInfinity);
}

// Truncate() moves failed_level to the first level that is not certified.
TEST_F(CertifierByHandTest, TruncatesToTheCertifiedLevels) {
  const auto truncated = [&](int failed_level, bool spoils_0, bool spoils_1) {
    Bound(0, 1, 2);
    if (spoils_0) solution_.levels[0].slack << 0.5;
    if (spoils_1) solution_.levels[1].multipliers[0].inequality << -1;
    solution_.failed_level = failed_level;
    if (failed_level >= 0) solution_.status = Status::kIterationLimit;
    certifier_.Truncate(hierarchy_, &solution_);
    EXPECT_LE(Certify().worst(), Certifier::kCertified);
    EXPECT_EQ(solution_.status == Status::kOptimal, solution_.failed_level < 0);
    return solution_.failed_level;
  };
  EXPECT_EQ(truncated(-1, false, false), -1);
  EXPECT_EQ(truncated(-1, false, true), 1);
  EXPECT_EQ(truncated(-1, true, false), 0);
  EXPECT_EQ(truncated(-1, true, true), 0);
  EXPECT_EQ(truncated(1, false, true), 1);
  EXPECT_EQ(truncated(1, true, false), 0);
  EXPECT_EQ(truncated(0, true, true), 0);
}

// Truncate() accepts a multiplier with an error far below kCertified, and
// rejects one with an error far above kCertified.
TEST_F(CertifierByHandTest, TruncatesAnswersThatAreNotCertified) {
  for (const double error : {0., 1e-15, 1e-11, 1e-7, 1e-3, 1.}) {
    Bound(0, 1, 2);
    solution_.levels[1].multipliers[0].inequality << 1 - error * kSize;
    certifier_.Truncate(hierarchy_, &solution_);
    const bool is_certified = error <= 1e-11;
    EXPECT_EQ(solution_.failed_level, is_certified ? -1 : 1) << error;
    EXPECT_EQ(solution_.status,
              is_certified ? Status::kOptimal : Status::kIterationLimit);
  }
}

}  // namespace
}  // namespace poise
