// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Rows that meet in a point with coordinates that are zero: what rounding leaves
// of these violates a row that asks for no less than zero by all that it has.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hqp/certificate.h"
#include "hqp/solver.h"

namespace poise {
namespace {

constexpr double kCertified = 1e-9;  // What the solver promises.

struct Row {
  int level;
  std::vector<double> row;
  double lower, upper;
};

// Where both sides are one, an equality.
struct Problem {
  Problem(int num_variables, const std::vector<Row>& rows)
      : capacity(Capacity(rows)), hierarchy(num_variables, capacity) {
    for (const Row& from : rows) {
      const auto row = Eigen::RowVectorXd::Map(from.row.data(), num_variables);
      if (from.lower == from.upper) {
        EqualityBlock to = hierarchy.AddEqualities(from.level, 1);
        to.B = row;
        to.b[0] = -from.lower;
        continue;
      }
      InequalityBlock to = hierarchy.AddInequalities(from.level, 1);
      to.C = row;
      to.lower[0] = from.lower;
      to.upper[0] = from.upper;
    }
  }

  static std::vector<LevelCapacity> Capacity(const std::vector<Row>& rows) {
    std::vector<LevelCapacity> capacity;
    for (const Row& row : rows) {
      capacity.resize(std::max<size_t>(capacity.size(), row.level + 1));
      ++(row.lower == row.upper ? capacity[row.level].equalities
                                : capacity[row.level].inequalities);
    }
    return capacity;
  }

  std::vector<LevelCapacity> capacity;
  Hierarchy hierarchy;
};

Solution Solve(const Problem& problem) {
  const int n = problem.hierarchy.num_variables();
  Solver solver(n, problem.capacity);
  Solution solution(n, problem.capacity);
  EXPECT_EQ(solver.Solve(problem.hierarchy, &solution), Status::kOptimal);
  EXPECT_LE(Certifier(n, problem.capacity)
                .Certify(problem.hierarchy, solution)
                .worst(),
            kCertified);
  return solution;
}

// -6e-17 for 0 is enough to break the row of the second level.
TEST(Vertex, HasAZeroWhereTwoRowsMeet) {
  const Problem problem(2, {{0, {4, 5}, -INFINITY, -5},
                            {0, {-2, 5}, -INFINITY, -5},
                            {1, {1, 0}, 0, INFINITY}});
  const Solution solution = Solve(problem);
  EXPECT_EQ(solution.y[0], 0);
  EXPECT_NEAR(solution.y[1], -1, 1e-15);  // Five roundings of 1.
}

// No rows are missed but the one that asks for zero: (0, 3) meets them all.
TEST(Vertex, HasAZeroWhereFiveRowsMeet) {
  const Problem problem(2, {{0, {1, 2}, -INFINITY, 6},
                            {0, {-1, 0}, 0, INFINITY},
                            {0, {3, -1}, -3, INFINITY},
                            {1, {-4, 1}, 3, INFINITY},
                            {2, {3, 3}, 9, INFINITY},
                            {2, {-5, 0}, 0, INFINITY}});
  const Solution solution = Solve(problem);
  EXPECT_EQ(solution.y[0], 0);
  EXPECT_NEAR(solution.y[1], 3, 3e-15);
}

// y2 is not alone: (0, -2, 0, 0) has three zeros, each of which another row ties
// to it.
TEST(Vertex, HasZerosThatOtherRowsTie) {
  const Problem problem(4, {{0, {0, -4, -1, 0}, 8, 8},
                            {0, {-3, 1, 0, 0}, -2, -2},
                            {1, {-3, 0, 0, 1}, 0, 0},
                            {1, {0, 0, 1, 0}, -INFINITY, 0},
                            {2, {0, 0, 1, -2}, 0, 0}});
  const Solution solution = Solve(problem);
  for (const int j : {0, 2, 3}) EXPECT_EQ(solution.y[j], 0) << j;
  EXPECT_NEAR(solution.y[1], -2, 2e-15);
}

// The last level asks for what three rows have already met, once refined.
TEST(Vertex, AsksNothingOfALevelThatRefinementHasMet) {
  const Problem problem(2, {{0, {2, 0}, 2, 2},
                            {0, {0, -3}, 0, 0},
                            {0, {-4, 5}, -4, -4},
                            {1, {0, -1}, 0, 0}});
  const Solution solution = Solve(problem);
  EXPECT_EQ(solution.y[1], 0);
  EXPECT_NEAR(solution.y[0], 1, 1e-15);
  EXPECT_TRUE(solution.levels[1].multipliers[0].equality.isZero(0));
}

// Whatever rows of small integers go through a point of small integers, on
// whatever side of them y may be: the point meets them all.
TEST(Vertex, IsFoundByWhateverRows) {
  for (int seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto draw = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    const int n = draw(2, 6), levels = draw(2, 3);
    std::vector<int> point(n);
    for (int& entry : point) entry = draw(0, 2) < 2 ? 0 : draw(-3, 3);
    std::vector<Row> rows;
    for (int level = 0; level < levels; ++level) {
      for (int i = draw(1, n + 2); i > 0; --i) {
        Row row{level, {}, -INFINITY, INFINITY};
        double value = 0;
        for (int j = 0; j < n; ++j) {
          row.row.push_back(draw(-5, 5));
          value += row.row[j] * point[j];
        }
        (draw(0, 1) == 0 ? row.lower : row.upper) = value;
        rows.push_back(row);
      }
    }
    const Problem problem(n, rows);
    const Solution solution = Solve(problem);
    for (int level = 0; level < levels; ++level) {
      // Terms of 5 * 3, of 6 variables, to 1e-13 of them, in 8 rows.
      EXPECT_LE(solution.levels[level].cost, 8 * std::pow(90e-13, 2));
    }
  }
}

// A foot that carries nothing: along its row momentum wants hardly anything, but
// more than nothing, and posture wants the other way.
TEST(Vertex, IsHeldByWhatAnUpperLevelHardlyAsksFor) {
  constexpr double kHardly = 3e-11;
  // The third asks z for 5e-12 of what the last two cannot agree on.
  const Problem problem(3, {{0, {0, 1, 0}, -INFINITY, 0},
                            {1, {1, 0, 0}, 0, 0},
                            {1, {1, kHardly, 0}, 1, 1},
                            {1, {0, 0, 1}, 0, 0},
                            {1, {0, 0, 1}, 6, 6},
                            {2, {0, 1, 0}, -1, -1}});
  const Solution solution = Solve(problem);
  EXPECT_NEAR(solution.y[0], 0.5, 1e-15);
  EXPECT_EQ(solution.y[1], 0);
  EXPECT_NEAR(solution.y[2], 3, 1e-15);
}

}  // namespace
}  // namespace poise
