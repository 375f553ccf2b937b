// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// A certificate is relative to the largest terms of its level, so that it is no
// proof where the terms of a level have very different sizes. Each test certifies
// an answer that was written by hand, not one of a solver. The exact optimum
// shows how wrong this answer is.
#include <gtest/gtest.h>

#include <Eigen/Core>
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
    solution.y = Eigen::VectorXd::Map(y.data(), y.size());
    for (int k = 0; k < problem.hierarchy.num_levels(); ++k) {
      EvaluateLevel(problem.hierarchy, k, &solution);
    }
  }

  double Worst() const {
    return Certifier(problem.hierarchy.num_variables(), problem.capacity)
        .Certify(problem.hierarchy, solution)
        .worst();
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

}  // namespace
}  // namespace poise
