// Compares both solvers with methods that need no active-set search. With
// equalities only, this is the closed form, level by level through
// pseudo-inverses. With inequalities, all active sets are tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Costs that differ by less are equal. This is far above rounding, and far
// below the difference between two active sets of rows in hundredths.
constexpr double kSameCost = 1e-9;

struct InequalityRow {
  int level, index;
};

// Returns the hierarchy with equalities only. Each inequality row is left out,
// or is an equality of its own level at the lower or the upper bound.
std::vector<LeastSquares> EqualitiesOnly(const Hierarchy& hierarchy,
                                         const std::vector<InequalityRow>& rows,
                                         const std::vector<Side>& sides) {
  std::vector<LeastSquares> levels;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    std::vector<size_t> active;
    for (size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].level == k && sides[i] != Side::kNone) active.push_back(i);
    }
    const int equalities = hierarchy.num_equalities(k);
    const int count = equalities + static_cast<int>(active.size());
    LeastSquares level{Eigen::MatrixXd(count, hierarchy.num_variables()),
                       Eigen::VectorXd(count), Eigen::VectorXd::Ones(count)};
    level.A.topRows(equalities) = hierarchy.B(k);
    level.b.head(equalities) = -hierarchy.b(k);
    level.weight.head(equalities) = hierarchy.weight(k);
    for (int a = 0, at = equalities; at < count; ++a, ++at) {
      const int index = rows[active[a]].index;
      level.A.row(at) = hierarchy.C(k).row(index);
      level.b[at] = sides[active[a]] == Side::kLower
                        ? hierarchy.lower(k)[index]
                        : hierarchy.upper(k)[index];
    }
    levels.push_back(level);
  }
  return levels;
}

struct Candidate {
  Eigen::VectorXd y;
  Eigen::VectorXd cost;  // Cost of each level of the hierarchy at y.
  double condition;
};

// Returns the optimum, by enumeration of all active sets. The optimum also
// solves an equality problem, that of the rows that are violated or tight at
// the optimum. No y has a lexicographically lower cost. So the optimum is the
// candidate of lowest cost, and among equal ones that of minimum norm.
Candidate FindByEnumeration(const HierarchyCase& drawn) {
  const Hierarchy& hierarchy = drawn.hierarchy;
  const int n = hierarchy.num_variables(), num_levels = hierarchy.num_levels();
  std::vector<InequalityRow> rows;
  for (int k = 0; k < num_levels; ++k) {
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      rows.push_back({k, i});
    }
  }
  std::vector<Candidate> candidates;
  Solution at(n, drawn.capacity);
  std::vector<Side> sides(rows.size(), Side::kNone);
  for (int code = 0; code < std::pow(3, rows.size()); ++code) {
    bool exists = true;
    for (size_t i = 0, rest = code; i < rows.size(); ++i, rest /= 3) {
      const double lower = hierarchy.lower(rows[i].level)[rows[i].index];
      const double upper = hierarchy.upper(rows[i].level)[rows[i].index];
      sides[i] = static_cast<Side>(static_cast<int>(rest % 3) - 1);
      exists &= sides[i] == Side::kNone ||
                std::isfinite(sides[i] == Side::kLower ? lower : upper);
    }
    if (!exists) continue;
    const LexicographicOptimum optimum =
        SolveLexicographically(n, EqualitiesOnly(hierarchy, rows, sides));
    at.y = optimum.y;
    Eigen::VectorXd cost(num_levels);
    for (int k = 0; k < num_levels; ++k) {
      EvaluateLevel(hierarchy, k, &at);
      cost[k] = at.levels[k].cost;
    }
    candidates.push_back({optimum.y, cost, optimum.condition});
  }
  for (int k = 0; k < num_levels; ++k) {
    double least = INFINITY;
    for (const Candidate& each : candidates) {
      least = std::min(least, each.cost[k]);
    }
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                    [&](const Candidate& each) {
                                      return each.cost[k] >
                                             least + kSameCost * (1 + least);
                                    }),
                     candidates.end());
  }
  return *std::min_element(candidates.begin(), candidates.end(),
                           [](const Candidate& a, const Candidate& b) {
                             return a.y.norm() < b.y.norm();
                           });
}

// Compares an answer with the enumerated one. Both tolerances grow with the
// square of the condition of the levels. The tolerance of a cost is relative to
// the magnitudes of its terms.
void Compare(const Candidate& expected, const HierarchyCase& drawn,
             const Solution& solution) {
  const Hierarchy& hierarchy = drawn.hierarchy;
  const int n = hierarchy.num_variables();
  const double condition = expected.condition * expected.condition;
  double size = 1 + expected.y.norm();
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    size += hierarchy.b(k).norm();
  }
  EXPECT_LE((solution.y - expected.y).norm(), Rounding(size, n, condition))
      << "expected y = " << expected.y.transpose();
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    EXPECT_NEAR(solution.levels[k].cost, expected.cost[k],
                Rounding(1 + CostSize(hierarchy, k, solution), n, condition))
        << "on level " << k;
  }
}

void CompareBoth(const Candidate& expected, const HierarchyCase& drawn) {
  const int n = drawn.hierarchy.num_variables();
  Solution solution(n, drawn.capacity);
  {
    SCOPED_TRACE("cascade");
    ASSERT_EQ(Cascade(n, drawn.capacity).Solve(drawn.hierarchy, &solution),
              Status::kOptimal);
    Compare(expected, drawn, solution);
  }
  SCOPED_TRACE("solver");
  ASSERT_EQ(Solver(n, drawn.capacity).Solve(drawn.hierarchy, &solution),
            Status::kOptimal);
  Compare(expected, drawn, solution);
}

TEST(Enumeration, AgreesWithBothSolvers) {
  RandomHierarchyOptions options;
  options.max_variables = 4;
  options.max_levels = 3;
  options.max_equalities = 2;
  options.max_inequalities = 2;
  options.selecting = 20;
  options.scaled = 0;
  for (int seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    CompareBoth(FindByEnumeration(drawn), drawn);
  }
}

TEST(ClosedForm, AgreesWithBothSolversOnEqualities) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<LeastSquares> levels = MakeRandomLevels(seed);
    const int n = static_cast<int>(levels[0].A.cols());
    const int num_levels = static_cast<int>(levels.size());
    std::vector<LevelCapacity> capacity;
    for (const LeastSquares& level : levels) {
      capacity.push_back({static_cast<int>(level.A.rows()), 0});
    }
    HierarchyCase drawn{capacity, Hierarchy(n, capacity)};
    const LexicographicOptimum optimum = SolveLexicographically(n, levels);
    Candidate expected{optimum.y, Eigen::VectorXd(num_levels),
                       optimum.condition};
    for (int k = 0; k < num_levels; ++k) {
      EqualityBlock rows =
          drawn.hierarchy.AddEqualities(k, capacity[k].equalities);
      rows.B = levels[k].A;
      rows.b = -levels[k].b;
      rows.weight = levels[k].weight;
      const Eigen::VectorXd r = levels[k].A * optimum.y - levels[k].b;
      expected.cost[k] = 0.5 * r.dot(levels[k].weight.cwiseProduct(r));
    }
    CompareBoth(expected, drawn);
    Solution solution(n, capacity);
    ASSERT_EQ(Solver(n, capacity).Solve(drawn.hierarchy, &solution),
              Status::kOptimal);
    for (int k = 0; k < num_levels; ++k) {
      EXPECT_EQ(solution.levels[k].nullity, n - optimum.rank[k]);
    }
  }
}

}  // namespace
}  // namespace poise
