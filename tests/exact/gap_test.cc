// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The gap of a certificate, against the exact optimum of small hierarchies, and
// between pairs of answers to large ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/exact/lexicographic_qp.h"
#include "poise/tests/exact/small_hierarchy.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

// How far the costs of an answer are above those of another one, while the
// levels above cost the same. Rounding of y in a level above may buy a lower
// cost below; the gap of that level covers it.
void ExpectWithinGaps(const Hierarchy& hierarchy, const Solution& solution,
                      const std::vector<double>& optimal, Certifier* certifier,
                      int* tight) {
  (void)certifier->Certify(hierarchy, solution);
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const double cost = solution.levels[level].cost;
    // The costs themselves are rounded in their last digits.
    EXPECT_LE(cost - optimal[level], certifier->gap(level) + 1e-14 * cost)
        << "level " << level;
    *tight += certifier->gap(level) <= 1e-6 * std::max(cost, 1.0);
  }
}

TEST(Gap, CoversTheExactOptimum) {
  int tight = 0, levels = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeSmallHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    const ExactOptimum exact = SolveExactly(hierarchy);
    std::vector<double> costs;
    for (const ExactLevel& level : exact.levels) {
      costs.push_back(level.cost.get_d());
    }
    Certifier certifier(n, drawn.capacity);
    Solution solution(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    ExpectWithinGaps(hierarchy, solution, costs, &certifier, &tight);
    levels += hierarchy.num_levels();
  }
  // A bound that is always the whole cost would be of no use.
  EXPECT_GE(tight, levels * 9 / 10);
}

// A box, rows that cannot all be met, and a target for each variable. In one of
// three, level 0 also fixes y_0 = 0. y is near the optimum of the rows, inside
// the box, and the multipliers sum to zero with the gradients, whatever their
// sign. So the gap of level 2 is that of the rows' slacks.
class Trade {
 public:
  explicit Trade(int seed)
      : random_(seed),
        n_(2 + seed % 3),
        num_bounds_(seed % 4),
        is_fixed_(seed % 9 < 3),
        hierarchy_(n_, capacity()) {
    hierarchy_.Clear(3);
    InequalityBlock box = hierarchy_.AddInequalities(0, n_);
    box.C.setIdentity();
    for (int j = 0; j < n_; ++j) {
      box.upper[j] = std::exp2(Whole(-4, 3));
      box.lower[j] = -std::exp2(Whole(-4, 3));
    }
    if (is_fixed_) hierarchy_.AddEqualities(0, 1).SetSingle(0, 0, 1);
    EqualityBlock rows = hierarchy_.AddEqualities(1, n_ + 1);
    InequalityBlock bounds = hierarchy_.AddInequalities(1, num_bounds_);
    for (double& entry : rows.B.reshaped()) entry = Whole(-3, 3);
    if (seed % 2 == 1) {  // These rows hardly determine one direction.
      rows.B.col(0) = rows.B.col(1) + rows.B.col(0) * std::exp2(-Whole(0, 10));
    }
    for (double& entry : rows.b) entry = Whole(-3, 3);
    for (double& weight : rows.weight) weight = Whole(1, 3);
    for (double& entry : bounds.C.reshaped()) entry = Whole(-3, 3);
    for (double& bound : bounds.upper) bound = Whole(-2, 2);
    EqualityBlock target = hierarchy_.AddEqualities(2, n_);
    target.B.setIdentity();
    for (double& entry : target.b) entry = Whole(-9, 9);
    solver_ = std::make_unique<Solver>(n_, capacity());
  }

  std::vector<LevelCapacity> capacity() const {
    return {{is_fixed_ ? 1 : 0, n_}, {n_ + 1, num_bounds_}, {n_, 0}};
  }
  const Hierarchy& hierarchy() const { return hierarchy_; }

  Solution Optimum() {
    Solution solution(n_, capacity());
    (void)solver_->Solve(hierarchy_, &solution);
    return solution;
  }

  // Answers with y at most `off` beside the optimum. Multipliers of level 2 on
  // the rows are W B p + f r, and a part of size `rest`. If that is not zero, p
  // is not the direction that the level wants either.
  Solution Answer(double off, double f, double rest) {
    Solution solution = Optimum();
    for (int j = 0; j < n_; ++j) {
      solution.y[j] += off * Whole(-8, 8) / 8;
      solution.y[j] = std::clamp(solution.y[j], hierarchy_.lower(0)[j],
                                 hierarchy_.upper(0)[j]);
    }
    if (is_fixed_) solution.y[0] = 0;
    for (int level = 0; level < 3; ++level)
      EvaluateLevel(hierarchy_, level, &solution);
    const auto B = hierarchy_.B(1), C = hierarchy_.C(1);
    const Eigen::VectorXd& y = solution.y;
    const Eigen::VectorXd r = B * y + hierarchy_.b(1);
    const Eigen::VectorXd v = (C * y - hierarchy_.upper(1)).cwiseMax(0);
    const Eigen::MatrixXd W = hierarchy_.weight(1).asDiagonal();
    const Eigen::VectorXd violated = (v.array() > 0).cast<double>();
    const Eigen::MatrixXd H =
        B.transpose() * W * B + C.transpose() * violated.asDiagonal() * C;
    const Eigen::VectorXd g_1 = B.transpose() * W * r + C.transpose() * v;
    const Eigen::VectorXd g_2 = y + hierarchy_.b(2);
    Eigen::VectorXd p = -LeastSquaresSolution(H, g_2 + f * g_1).x;
    for (double& entry : p) entry += rest * Whole(-3, 3);
    std::vector<LevelSolution>& levels = solution.levels;
    levels[1].multipliers[0].inequality = -g_1;
    LevelMultipliers& on_rows = levels[2].multipliers[1];
    on_rows.equality = W * (B * p + f * r);
    on_rows.inequality = violated.asDiagonal() * (C * p) + f * v;
    for (double& entry : on_rows.equality) entry += rest * Whole(-3, 3);
    levels[2].multipliers[0].inequality = -g_2 -
                                          B.transpose() * on_rows.equality -
                                          C.transpose() * on_rows.inequality;
    for (LevelSolution* level : {&levels[1], &levels[2]}) {
      LevelMultipliers& of = level->multipliers[0];
      if (is_fixed_) of.equality[0] = std::exchange(of.inequality[0], 0);
    }
    levels[2].traded_level = 1;
    levels[2].trade_off = p;
    return solution;
  }

 private:
  int Whole(int low, int high) {
    return low + static_cast<int>(random_() % (high - low + 1));
  }

  std::mt19937_64 random_;
  int n_, num_bounds_;
  bool is_fixed_;
  Hierarchy hierarchy_;
  std::unique_ptr<Solver> solver_;
};

TEST(Gap, CoversAnswersWithAnyMultipliers) {
  int sharp = 0, answers = 0;
  for (int seed = 0; seed < 300; ++seed) {
    Trade trade(seed);
    const ExactOptimum exact = SolveExactly(trade.hierarchy());
    Certifier certifier(trade.hierarchy().num_variables(), trade.capacity());
    for (const double off : {1e-8, 1e-4, 1e-2, 0.5}) {
      for (const double f : {0., 10., -10.}) {
        for (const double rest : {0., 0.1}) {
          SCOPED_TRACE(testing::Message()
                       << seed << ", " << off << ", " << f << ", " << rest);
          const Solution solution = trade.Answer(off, f, rest);
          (void)certifier.Certify(trade.hierarchy(), solution);
          for (int level = 0; level < 3; ++level) {
            const double cost = solution.levels[level].cost;
            const double excess = cost - exact.levels[level].cost.get_d();
            EXPECT_LE(excess, certifier.gap(level) + 1e-14 * cost)
                << "level " << level;
          }
          if (off > 1e-4 || rest > 0) continue;
          ++answers;
          // Linear in `off`, with a factor for the condition of the rows.
          sharp += certifier.gap(2) <= 1e2 * off * solution.levels[2].cost;
        }
      }
    }
  }
  // A bound that is always far off would be of no use. Negative f and rows that
  // hardly determine a direction make most of these bounds large.
  EXPECT_GE(sharp, answers / 6);
}

// The solver's trade-offs only make gaps smaller, and often by much.
TEST(Gap, IsSharpWithTheTradeOffsOfTheSolver) {
  int sharper = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Trade trade(seed);
    Certifier certifier(trade.hierarchy().num_variables(), trade.capacity());
    Solution solution = trade.Optimum();
    (void)certifier.Certify(trade.hierarchy(), solution);
    const double with = certifier.gap(2);
    solution.levels[2].traded_level = -1;
    (void)certifier.Certify(trade.hierarchy(), solution);
    EXPECT_LE(with, certifier.gap(2));
    sharper += with < certifier.gap(2) / 100;
  }
  EXPECT_GE(sharper, 100);
}

// The gaps of a solver that was stopped. A level is compared if the levels
// above cost what they must.
TEST(Gap, CoversASolverThatWasStopped) {
  int stopped = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const HierarchyCase drawn = MakeSmallHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    const ExactOptimum exact = SolveExactly(hierarchy);
    Solution solution(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    for (int limit = 0; limit < 12; ++limit) {
      SCOPED_TRACE(testing::Message() << seed << ", " << limit);
      solver.Forget();
      solver.max_iterations = limit;
      stopped += solver.Solve(hierarchy, &solution) != Status::kOptimal;
      for (int level = 0; level < hierarchy.num_levels(); ++level) {
        const double cost = solution.levels[level].cost;
        const double optimal = exact.levels[level].cost.get_d();
        EXPECT_LE(cost - optimal, solution.levels[level].gap + 1e-14 * cost)
            << "level " << level;
        // The data are whole numbers, so that costs of 1e-12 are rounding.
        if (std::abs(cost - optimal) > 1e-12 * (1 + optimal)) break;
      }
    }
  }
  EXPECT_GT(stopped, 200);
}

// Fast and cascade, and the fast solver warm, on hierarchies of control size.
TEST(Gap, CoversTheDifferenceOfTwoSolvers) {
  int tight = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    Solution first(n, drawn.capacity), second(n, drawn.capacity);
    Certifier certifier(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    Cascade cascade(n, drawn.capacity);
    if (solver.Solve(hierarchy, &first) != Status::kOptimal) continue;
    if (cascade.Solve(hierarchy, &second) != Status::kOptimal) continue;
    std::vector<double> costs[2];
    for (int level = 0; level < hierarchy.num_levels(); ++level) {
      costs[0].push_back(first.levels[level].cost);
      costs[1].push_back(second.levels[level].cost);
    }
    ExpectWithinGaps(hierarchy, first, costs[1], &certifier, &tight);
    ExpectWithinGaps(hierarchy, second, costs[0], &certifier, &tight);
    ASSERT_EQ(solver.Solve(hierarchy, &second), Status::kOptimal);
    ExpectWithinGaps(hierarchy, second, costs[1], &certifier, &tight);
  }
  EXPECT_GT(tight, 0);
}

}  // namespace
}  // namespace poise
