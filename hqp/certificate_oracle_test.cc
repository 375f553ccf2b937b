// Compares the certificate with its definition in matrix form. The answers are
// optimal answers to random hierarchies, the same answers with one or all
// numbers replaced, and answers with rows close to a bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/tolerances.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Both constants are part of the definition.
using tolerances::kAtBound;
using tolerances::kZeroCost;

// Tolerance for quotients of small whole numbers.
constexpr double kRounding = 1e-15;

// The bounded rows in the form A y + a <= 0. Of two bounds, a row has the one
// with the larger violation.
struct OneSided {
  MatrixXd A;
  VectorXd a, mu, slack;
  std::vector<bool> is_tight;  // The bounds are equal within the margin.

  VectorXd Violation(const VectorXd& y) const { return A * y + a; }
  VectorXd Size(const VectorXd& y) const {
    return A.cwiseAbs() * y.cwiseAbs() + a.cwiseAbs();
  }
  double Margin(int i, const VectorXd& y) const {
    return kAtBound * (A.row(i).norm() * y.norm() + std::abs(a[i]));
  }
};

OneSided MakeOneSided(const Hierarchy& hierarchy, int level,
                      const VectorXd& multipliers, const Solution& solution) {
  const VectorXd& y = solution.y;
  const VectorXd value = hierarchy.C(level) * y;
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  std::vector<int> bounded;
  for (int i = 0; i < value.size(); ++i) {
    if (std::isfinite(lower[i]) || std::isfinite(upper[i])) {
      bounded.push_back(i);
    }
  }
  const int rows = static_cast<int>(bounded.size());
  OneSided one{MatrixXd(rows, y.size()),
               VectorXd(rows),
               VectorXd(rows),
               VectorXd(rows),
               {}};
  for (int r = 0; r < rows; ++r) {
    const int i = bounded[r];
    const double sign = value[i] - upper[i] >= lower[i] - value[i] ? 1 : -1;
    one.A.row(r) = sign * hierarchy.C(level).row(i);
    one.a[r] = -sign * (sign > 0 ? upper[i] : lower[i]);
    one.mu[r] = multipliers.size() > 0 ? sign * multipliers[i] : 0;
    one.slack[r] = solution.levels[level].slack[i];
    one.is_tight.push_back(upper[i] - lower[i] <= one.Margin(r, y));
  }
  return one;
}

double LargestRatio(const VectorXd& error, const VectorXd& size) {
  double largest = 0;
  for (int i = 0; i < error.size(); ++i) {
    if (error[i] != 0) {
      largest = std::max(largest, std::abs(error[i]) / size[i]);
    }
  }
  return largest;
}

Certificate CertifyByDefinition(const Hierarchy& hierarchy,
                                const Solution& solution) {
  Certificate result;
  const VectorXd& y = solution.y;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    const LevelSolution& answer = solution.levels[k];
    const MatrixXd B = hierarchy.B(k), W = hierarchy.weight(k).asDiagonal();
    const VectorXd w = B * y + hierarchy.b(k);
    const VectorXd w_size =
        B.cwiseAbs() * y.cwiseAbs() + hierarchy.b(k).cwiseAbs();
    const OneSided own = MakeOneSided(hierarchy, k, VectorXd(), solution);
    const VectorXd v = own.Violation(y).cwiseMax(0), v_size = own.Size(y);
    const MatrixXd is_violated =
        (v.array() > 0).cast<double>().matrix().asDiagonal();

    result.feasibility = std::max(
        {result.feasibility,
         LargestRatio(w - answer.equality_residual.head(w.size()), w_size),
         LargestRatio(v - own.slack, v_size)});
    const double cost = 0.5 * (w.dot(W * w) + v.squaredNorm());
    const double cost_size =
        0.5 * (w_size.dot(W * w_size) + v_size.squaredNorm());
    result.priority = std::max(
        result.priority,
        LargestRatio(VectorXd::Constant(1, cost - answer.cost),
                     VectorXd::Constant(1, cost + kZeroCost * cost_size)));

    VectorXd g = B.transpose() * (W * w) + own.A.transpose() * v;
    VectorXd g_size = B.cwiseAbs().transpose() * (W * w_size) +
                      own.A.cwiseAbs().transpose() * (is_violated * v_size);
    VectorXd wrong = VectorXd::Zero(1);
    for (int j = 0; j < k; ++j) {
      const LevelMultipliers& multipliers = answer.multipliers[j];
      const MatrixXd B_j = hierarchy.B(j);
      const VectorXd lambda = multipliers.equality.head(B_j.rows());
      const OneSided above =
          MakeOneSided(hierarchy, j, multipliers.inequality, solution);
      g += B_j.transpose() * lambda + above.A.transpose() * above.mu;
      g_size += B_j.cwiseAbs().transpose() * lambda.cwiseAbs() +
                above.A.cwiseAbs().transpose() * above.mu.cwiseAbs();
      for (int i = 0; i < above.mu.size(); ++i) {
        const double violation = above.Violation(y)[i];
        const double margin = above.Margin(i, y), mu = above.mu[i];
        const bool has_gap = violation < -margin;
        const bool at_bound =
            !has_gap && violation <= margin && !above.is_tight[i];
        if (has_gap || (at_bound && mu < 0)) {
          wrong[0] = std::max(
              wrong[0], above.A.row(i).cwiseAbs().maxCoeff() * std::abs(mu));
        }
      }
    }
    const VectorXd size = VectorXd::Constant(1, g_size.maxCoeff());
    const VectorXd largest = VectorXd::Constant(1, g.cwiseAbs().maxCoeff());
    result.stationarity =
        std::max(result.stationarity, LargestRatio(largest, size));
    result.complementarity =
        std::max(result.complementarity, LargestRatio(wrong, size));
  }
  return result;
}

// Rounding is 1e-16 of the magnitudes of the terms. The changes made by the
// tests are far larger.
void ExpectSame(double actual, double expected) {
  if (std::isinf(expected)) {
    EXPECT_EQ(actual, expected);
  } else {
    EXPECT_NEAR(actual, expected, 1e-13 + 1e-9 * expected);
  }
}

void ExpectAsDefined(const HierarchyCase& drawn, const Solution& solution) {
  const Certificate actual =
      Certifier(drawn.hierarchy.num_variables(), drawn.capacity)
          .Certify(drawn.hierarchy, solution);
  const Certificate expected = CertifyByDefinition(drawn.hierarchy, solution);
  ExpectSame(actual.stationarity, expected.stationarity);
  ExpectSame(actual.feasibility, expected.feasibility);
  ExpectSame(actual.complementarity, expected.complementarity);
  ExpectSame(actual.priority, expected.priority);
  EXPECT_EQ(actual.worst(),
            std::max({actual.stationarity, actual.feasibility,
                      actual.complementarity, actual.priority}));
}

// Returns pointers to all numbers of an answer that the certificate reads.
std::vector<double*> Numbers(const Hierarchy& hierarchy, Solution* solution) {
  std::vector<double*> numbers;
  const auto add = [&](VectorXd* from, int count) {
    for (int i = 0; i < count; ++i) numbers.push_back(&(*from)[i]);
  };
  add(&solution->y, hierarchy.num_variables());
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    LevelSolution& level = solution->levels[k];
    numbers.push_back(&level.cost);
    add(&level.equality_residual, hierarchy.num_equalities(k));
    add(&level.slack, hierarchy.num_inequalities(k));
    for (int j = 0; j < k; ++j) {
      add(&level.multipliers[j].equality, hierarchy.num_equalities(j));
      add(&level.multipliers[j].inequality, hierarchy.num_inequalities(j));
    }
  }
  return numbers;
}

TEST(CertificateOracle, AgreesWithTheDefinitionOnWrongAnswers) {
  RandomHierarchyOptions options;
  options.max_variables = 5;
  options.max_levels = 4;
  options.max_equalities = 3;
  options.max_inequalities = 4;
  std::mt19937 random(1);
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    Solution answer(n, drawn.capacity);
    ASSERT_EQ(Cascade(n, drawn.capacity).Solve(drawn.hierarchy, &answer),
              Status::kOptimal);
    ExpectAsDefined(drawn, answer);
    const auto draw = [&] {
      return (static_cast<int>(random() % 601) - 300) / 100.0;
    };
    for (size_t i = 0; i < Numbers(drawn.hierarchy, &answer).size(); ++i) {
      SCOPED_TRACE(i);
      Solution spoiled = answer;
      *Numbers(drawn.hierarchy, &spoiled)[i] += draw();
      ExpectAsDefined(drawn, spoiled);
    }
    Solution wrong = answer;
    for (double* number : Numbers(drawn.hierarchy, &wrong)) *number = draw();
    ExpectAsDefined(drawn, wrong);
  }
}

// Level 0: 5 y1 <= 5, with the bound moved by some margins. Level 1: y = 0. The
// answer is y = (10, 1). The margin of the row is relative to |C| |y| + |bound|
// = 5 |y| + 5 = 55, not to 5 |y1| + 5 = 10.
class MarginTest : public testing::Test {
 protected:
  // Returns the complementarity error of a multiplier on the row. The row is
  // violated by `violation` margins, and its bounds are `width` margins apart.
  double Wrong(double violation, double multiplier, double width = INFINITY) {
    Solution solution(2, capacity_);
    solution.y << 10, 1;
    const double margin = kAtBound * (5 * std::sqrt(101) + 5);
    Hierarchy hierarchy(2, capacity_);
    InequalityBlock row = hierarchy.AddInequalities(0, 1);
    row.C << 0, 5;
    row.upper << 5 - violation * margin;
    row.lower << row.upper[0] - width * margin;
    EqualityBlock target = hierarchy.AddEqualities(1, 2);
    target.B.setIdentity();
    EvaluateLevel(hierarchy, 0, &solution);
    EvaluateLevel(hierarchy, 1, &solution);
    solution.levels[1].multipliers[0].inequality << multiplier;
    return Certifier(2, capacity_).Certify(hierarchy, solution).complementarity;
  }

  static constexpr double kWrong = 2. * 5 / (1 + 2 * 5);
  const std::vector<LevelCapacity> capacity_{{0, 1}, {2, 0}};
};

TEST_F(MarginTest, AllowsAnyMultiplierOnAViolatedRow) {
  for (const double violation : {2., 1e3, 1e6}) {
    EXPECT_EQ(Wrong(violation, -2), 0);
    EXPECT_EQ(Wrong(violation, 2), 0);
  }
  for (const double violation : {0., 1e-3, 0.5}) {
    EXPECT_EQ(Wrong(violation, -2), kWrong);
    EXPECT_EQ(Wrong(violation, 2), 0);
  }
}

TEST_F(MarginTest, RejectsAMultiplierFarInsideABound) {
  for (const double gap : {1e-3, 0.5}) {
    EXPECT_EQ(Wrong(-gap, 2), 0);
    EXPECT_EQ(Wrong(-gap, -2), kWrong);
  }
  for (const double gap : {2., 1e3, 1e6}) {
    EXPECT_EQ(Wrong(-gap, 2), kWrong);
    EXPECT_EQ(Wrong(-gap, -2), kWrong);
  }
}

TEST_F(MarginTest, AllowsAnyMultiplierBetweenTwoNearlyEqualBounds) {
  EXPECT_EQ(Wrong(-0.2, -2, 0.5), 0);
  EXPECT_EQ(Wrong(-0.2, 2, 0.5), 0);
  EXPECT_EQ(Wrong(-0.2, -2, 1.5), kWrong);
  EXPECT_EQ(Wrong(-0.2, 2, 1.5), 0);
  EXPECT_EQ(Wrong(-1.2, -2, 1.5), 0);  // The lower bound is nearer.
  EXPECT_EQ(Wrong(-1.2, 2, 1.5), kWrong);
}

TEST(CertificateOracle, IgnoresARowWithoutBounds) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock rows = hierarchy.AddInequalities(0, 2);
  rows.C << 1, 1;
  rows.upper[0] = 1;
  hierarchy.AddEqualities(1, 1).B << 1;
  Solution solution(1, capacity);
  Certifier certifier(1, capacity);
  EXPECT_EQ(certifier.Certify(hierarchy, solution).worst(), 0);
  // The cost is relative to kZeroCost 1^2 / 2, from the bounded row alone.
  solution.levels[0].cost = kZeroCost;
  EXPECT_NEAR(certifier.Certify(hierarchy, solution).priority, 2, kRounding);
  solution.levels[0].cost = 0;
  solution.levels[0].slack[1] = 1;  // A row without bounds has size 0.
  EXPECT_EQ(certifier.Certify(hierarchy, solution).feasibility, INFINITY);
  solution.levels[0].slack[1] = 0;
  solution.levels[1].multipliers[0].inequality[1] = 3;
  EXPECT_EQ(certifier.Certify(hierarchy, solution).complementarity, 1);
}

// At y = 0 a row with bound 0 has a margin of 0, and is at its bound.
TEST(CertificateOracle, TreatsARowOfSizeZeroAsAtItsBound) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  InequalityBlock row = hierarchy.AddInequalities(0, 1);
  row.C << 3, 4;
  row.upper << 0;
  hierarchy.AddEqualities(1, 2).B.setIdentity();
  Solution solution(2, capacity);
  const auto wrong = [&](double multiplier) {
    solution.levels[1].multipliers[0].inequality << multiplier;
    return Certifier(2, capacity).Certify(hierarchy, solution).complementarity;
  };
  EXPECT_EQ(wrong(2), 0);
  EXPECT_EQ(wrong(-2), 1);
  row.lower << 0;
  EXPECT_EQ(wrong(2), 0);
  EXPECT_EQ(wrong(-2), 0);
}

// If both bounds are equally distant, the certificate uses the upper one. The
// cost is then relative to 1e-9 (1 + 3)^2 / 2.
TEST(CertificateOracle, UsesTheUpperOfTwoEquallyDistantBounds) {
  const std::vector<LevelCapacity> capacity{{0, 1}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock row = hierarchy.AddInequalities(0, 1);
  row.C << 1;
  row.lower << -1;
  row.upper << 3;
  Solution solution(1, capacity);
  solution.y << 1;
  solution.levels[0].cost = kZeroCost;
  EXPECT_NEAR(Certifier(1, capacity).Certify(hierarchy, solution).priority,
              1. / 8, kRounding);
}

TEST(CertificateOracle, CertifiesRowsWithoutVariables) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 1}};
  Hierarchy hierarchy(0, capacity);
  hierarchy.AddEqualities(0, 1);
  hierarchy.AddInequalities(0, 1);
  EXPECT_EQ(
      Certifier(0, capacity).Certify(hierarchy, Solution(0, capacity)).worst(),
      0);
}

TEST(CertificateOracle, IsInfiniteIfAnyNumberIsNan) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 0}};
  Hierarchy hierarchy(2, capacity);
  hierarchy.AddEqualities(0, 1).B << 0, 1;
  InequalityBlock row = hierarchy.AddInequalities(0, 1);
  row.C << 1, 0;
  row.upper[0] = 1;
  hierarchy.AddEqualities(1, 1).B << 0, 1;
  Solution solution(2, capacity);
  Certifier certifier(2, capacity);
  for (double* number : Numbers(hierarchy, &solution)) {
    const double right = *number;
    *number = NAN;
    EXPECT_EQ(certifier.Certify(hierarchy, solution).worst(), INFINITY);
    *number = right;
    EXPECT_EQ(certifier.Certify(hierarchy, solution).worst(), 0);
  }
}

}  // namespace
}  // namespace poise
