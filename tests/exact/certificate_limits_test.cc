// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A certificate is relative to the largest terms of its level, so that it is no
// proof where the terms of a level have very different sizes. The gap assumes
// that y meets the levels above, and that no optimum is far away. Each test
// certifies an answer that was written by hand, not one of a solver. The exact
// optimum shows how wrong this answer is.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/tests/exact/lexicographic_qp.h"
#include "poise/tests/util/hierarchy_by_hand.h"

namespace poise {
namespace {

// An answer y with its true residuals, slacks and costs, and no multipliers.
struct Answer {
  Answer(const HierarchyByHand& of, const std::vector<double>& y)
      : problem(of),
        solution(problem.hierarchy.num_variables(), problem.capacity) {
    solution.Reset();
    std::copy(y.begin(), y.end(), solution.y.begin());
    for (int k = 0; k < problem.hierarchy.num_levels(); ++k) {
      EvaluateLevel(problem.hierarchy, k, &solution);
    }
  }

  double Worst() const {
    return Certifier(problem.hierarchy.num_variables(), problem.capacity)
        .Certify(problem.hierarchy, solution)
        .worst();
  }

  double Gap(int level) const {
    Certifier certifier(problem.hierarchy.num_variables(), problem.capacity);
    (void)certifier.Certify(problem.hierarchy, solution);
    return certifier.gap(level);
  }

  // How much more a level costs at y than at the exact optimum.
  double Excess(int level) const {
    const Rational excess = Rational(solution.levels[level].cost) -
                            SolveExactly(problem.hierarchy).levels[level].cost;
    return excess.get_d();
  }

  const HierarchyByHand problem;
  Solution solution;
};

// Expects a certified answer with this cost, where the optimum has another.
void ExpectCertifiedButWrong(const Answer& answer, int level, double cost,
                             const Rational& optimal_cost) {
  EXPECT_LE(answer.Worst(), Certifier::kCertified);
  EXPECT_EQ(answer.solution.levels[level].cost, cost);
  EXPECT_EQ(SolveExactly(answer.problem.hierarchy).levels[level].cost,
            optimal_cost);
}

// Rows norm y0 = norm and y1 = 1 on one level.
HierarchyByHand TwoNorms(double norm) {
  return {2, {{0, {norm, 0}, norm, norm}, {0, {0, 1}, 1, 1}}};
}

// The large-norm row is met by terms of norm^2 + norm^2. Beside them the
// gradient of the other row, -1, is small.
TEST(CertificateLimits, MissesASmallRowBesideOneOf1e6) {
  ExpectCertifiedButWrong(Answer(TwoNorms(1e6), {1, 0}), 0, 0.5, 0);
}

// The certificate is 1 / (2 norm^2). It exceeds 1e-9 up to a norm of 22 361.
TEST(CertificateLimits, SeesASmallRowBesideOneOf2e4) {
  EXPECT_GT(Answer(TwoNorms(2.2e4), {1, 0}).Worst(), Certifier::kCertified);
  EXPECT_LE(Answer(TwoNorms(2.3e4), {1, 0}).Worst(), Certifier::kCertified);
}

// A joint of small mass: 20 of the body beside 1e-7 of the finger. The answer
// violates the finger's row, so that the next level has no cost at all.
TEST(CertificateLimits, MissesAJointOfSmallMass) {
  const double small = std::ldexp(1, -23);  // 1.2e-7.
  const HierarchyByHand problem(
      2,
      {{0, {20, 0}, 20, 20}, {0, {0, small}, small, small}, {1, {0, 1}, 0, 0}});
  const Answer answer(problem, {1, 0});
  ExpectCertifiedButWrong(answer, 1, 0, Rational(1, 2));
  EXPECT_LT(answer.solution.levels[0].cost, 1e-14);
}

// Multipliers of two equal rows cancel, but the gradient is relative to each.
TEST(CertificateLimits, MissesALevelBesideMultipliersOf1e9) {
  const HierarchyByHand problem(
      2, {{0, {1, 0}, 0, 0}, {0, {1, 0}, 0, 0}, {1, {0, 1}, 1, 1}});
  Answer answer(problem, {0, 0});
  EXPECT_EQ(answer.Worst(), 1);
  answer.solution.levels[1].multipliers[0].equality << 1e9, -1e9;
  ExpectCertifiedButWrong(answer, 1, 0.5, 0);
}

// The row y0 + y1 <= 0 is violated by 1, which is small beside y0 = 2e9.
TEST(CertificateLimits, MissesAViolationBesideLargeVariables) {
  const HierarchyByHand problem(2, {{0, {1, 1}, -INFINITY, 0}});
  ExpectCertifiedButWrong(Answer(problem, {2e9, 1 - 2e9}), 0, 0.5, 0);
}

// One variable with the targets 1, 1 + delta and delta on levels 0 to 2, and
// the answer 1 + delta. Level 2 has its multiplier 1 on the row of level 0 or
// of level 1.
Answer ThreeTargets(double delta, int level_of_multiplier) {
  Answer answer(HierarchyByHand(1, {{0, {1}, 1, 1},
                                    {1, {1}, 1 + delta, 1 + delta},
                                    {2, {1}, delta, delta}}),
                {1 + delta});
  answer.solution.levels[2].multipliers[level_of_multiplier].equality[0] = -1;
  return answer;
}

// Level 0 is certified because its residual delta is small beside its target.
// Level 1 is met, so that its gap is zero, although level 0 does not allow its
// target.
TEST(CertificateLimits, GapMissesAnAnswerThatMeetsALevelBelowTooWell) {
  const double delta = 0x1p-30;  // 9.3e-10.
  const Answer answer = ThreeTargets(delta, 1);
  EXPECT_LE(answer.Worst(), Certifier::kCertified);
  EXPECT_EQ(answer.Excess(2), delta - delta * delta / 2);
  EXPECT_LT(answer.Gap(2), answer.Excess(2) / 100);
  // With the multiplier on level 0, which y misses, the gap is the change of
  // its residual.
  EXPECT_LE(ThreeTargets(delta, 0).Worst(), Certifier::kCertified);
  EXPECT_GE(ThreeTargets(delta, 0).Gap(2), delta - delta * delta / 2);
}

// The certificate of level 0 is delta / (2 + delta). It exceeds 1e-9 from a
// delta of 2e-9 on.
TEST(CertificateLimits, SeesATargetMissedBy2e9) {
  EXPECT_LE(ThreeTargets(1.9e-9, 1).Worst(), Certifier::kCertified);
  EXPECT_GT(ThreeTargets(2.1e-9, 1).Worst(), Certifier::kCertified);
}

// Level 0 bounds y1 by `bound`. Level 1 has the rows y0 = 1 and y0 + slope y1 =
// 2, and the answer (1.5, 0) misses each by 0.5. Both are met at (1, 1 /
// slope).
Answer NearlyEqualRows(double slope, double bound) {
  return Answer(HierarchyByHand(2, {{0, {0, 1}, -bound, bound},
                                    {1, {1, 0}, 1, 1},
                                    {1, {1, slope}, 2, 2}}),
                {1.5, 0});
}

// The gap is the gradient slope / 2 times R = 2 (1.5 + 2), while the cost falls
// by about slope / 2 times the distance of the optimum.
TEST(CertificateLimits, GapMissesAnOptimumFartherThanR) {
  const double slope = 0x1p-32;  // 2.3e-10.
  const double radius = 2 * (1.5 + 2);
  const Answer within = NearlyEqualRows(slope, 4),
               beyond = NearlyEqualRows(slope, 64),
               far = NearlyEqualRows(slope, 2 / slope);
  for (const Answer* answer : {&within, &beyond, &far}) {
    EXPECT_LE(answer->Worst(), Certifier::kCertified);
    EXPECT_GE(answer->Gap(1), slope / 2 * radius);
    // The rest is rounding: 12 eps / 2 of the gradient's terms, 6, times R is
    // 5.6e-14.
    EXPECT_LE(answer->Gap(1), slope / 2 * radius + 1e-13);
  }
  EXPECT_LE(within.Excess(1), within.Gap(1));
  EXPECT_GT(beyond.Excess(1), 9 * beyond.Gap(1));  // 64 is 9.1 R.
  EXPECT_EQ(far.Excess(1), 0.25);                  // The whole cost.
}

}  // namespace
}  // namespace poise
