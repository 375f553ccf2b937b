// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/reference/cascade.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "poise/hqp/certificate.h"
#include "poise/tests/util/copy_level.h"
#include "poise/tests/util/lexicographic.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/solve_cascade.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-14;  // A few operations on numbers near 1.
constexpr double kCertified = 1e-10;  // Row norms of up to 1e6 give 1e-11.

// Level 0: y0 <= 1 and y1 >= 2. Level 1: y0 + y1 = 4. Level 2: y = (5, 0).
class CascadeTest : public testing::Test {
 protected:
  CascadeTest() {
    InequalityBlock bounds = hierarchy_.AddInequalities(0, 2);
    bounds.C.setIdentity();
    bounds.upper[0] = 1;
    bounds.lower[1] = 2;
    EqualityBlock sum = hierarchy_.AddEqualities(1, 1);
    sum.B << 1, 1;
    sum.b << -4;
    EqualityBlock target = hierarchy_.AddEqualities(2, 2);
    target.B.setIdentity();
    target.b << -5, 0;
    target_ = target.b.data();
  }

  const std::vector<LevelCapacity> capacity_{{0, 2}, {1, 0}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
  double* target_;
  Cascade cascade_{2, capacity_};
  Solution solution_{2, capacity_};
  Certifier certifier_{2, capacity_};
};

TEST_F(CascadeTest, SolvesByHand) {
  ASSERT_EQ(cascade_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_NEAR(solution_.y[0], 1, kTolerance);
  EXPECT_NEAR(solution_.y[1], 3, kTolerance);
  EXPECT_NEAR(solution_.levels[2].cost, 12.5, 10 * kTolerance);
  EXPECT_EQ(solution_.levels[0].nullity, 2);
  EXPECT_EQ(solution_.levels[1].nullity, 1);
  EXPECT_EQ(solution_.levels[2].nullity, 0);
  EXPECT_EQ(solution_.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution_.levels[0].active[1], Side::kNone);
  // g = (-4, 3) + lambda (1, 1) + mu (1, 0) = 0.
  EXPECT_NEAR(solution_.levels[2].multipliers[1].equality[0], -3,
              10 * kTolerance);
  EXPECT_NEAR(solution_.levels[2].multipliers[0].inequality[0], 7,
              10 * kTolerance);
  EXPECT_LE(certifier_.Certify(hierarchy_, solution_).worst(), kTolerance);
}

TEST_F(CascadeTest, ReportsNumbersThatAreNotFinite) {
  ASSERT_EQ(cascade_.Solve(hierarchy_, &solution_), Status::kOptimal);
  target_[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cascade_.Solve(hierarchy_, &solution_), Status::kNotFinite);
  EXPECT_EQ(solution_.failed_level, 2);
  EXPECT_EQ(solution_.y, Eigen::Vector2d(0, 0));
}

// Returns a random hierarchy with few variables, and with rows of all kinds.
HierarchyCase Draw(int seed) {
  RandomHierarchyOptions options;
  options.max_variables = 4;
  options.max_levels = 4;
  options.max_equalities = 3;
  options.max_inequalities = 3;
  return MakeRandomHierarchy(seed, options);
}

// Returns the first levels of a hierarchy, with targets and bounds in another
// unit.
HierarchyCase Part(const HierarchyCase& drawn, int levels, double unit = 1) {
  const Hierarchy& from = drawn.hierarchy;
  HierarchyCase part{drawn.capacity,
                     Hierarchy(from.num_variables(), drawn.capacity)};
  part.hierarchy.Clear(levels);
  for (int k = 0; k < levels; ++k) {
    LevelBlocks rows = CopyLevel(from, k, &part.hierarchy);
    rows.equalities.b *= unit;
    rows.inequalities.lower *= unit;
    rows.inequalities.upper *= unit;
  }
  return part;
}

class EitherCascadeTest : public testing::TestWithParam<RowSpaceMethod> {};

TEST_P(EitherCascadeTest, IsCertified) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = Draw(seed);
    EXPECT_LE(Certifier(drawn.hierarchy.num_variables(), drawn.capacity)
                  .Certify(drawn.hierarchy, SolveCascade(drawn, GetParam()))
                  .worst(),
              kCertified);
  }
}

// The nullity is the number of variables minus the rank of all equalities and
// violated rows so far. Each violated row is active at the violated side.
TEST_P(EitherCascadeTest, CountsEqualitiesAndViolatedRows) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = Draw(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    const Solution solution = SolveCascade(drawn, GetParam());
    Eigen::MatrixXd rows(0, n);
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      const auto add = [&](const Eigen::VectorXd& row) {
        if (row.norm() == 0) return;
        rows.conservativeResize(rows.rows() + 1, n);
        rows.bottomRows(1) = row.transpose() / row.norm();
      };
      for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
        if (hierarchy.weight(k)[i] > 0) add(hierarchy.B(k).row(i));
      }
      for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
        const Eigen::VectorXd row = hierarchy.C(k).row(i);
        const double value = row.dot(solution.y);
        const double above = value - hierarchy.upper(k)[i];
        const double below = hierarchy.lower(k)[i] - value;
        // Far above rounding, and below any real violation of rows with entries
        // in hundredths.
        const double zero = 1e-7 * (1 + row.norm());
        const Side side = above > zero   ? Side::kUpper
                          : below > zero ? Side::kLower
                                         : Side::kNone;
        if (side != Side::kNone) add(row);
        if (side != Side::kNone && row.norm() > 0) {
          EXPECT_EQ(solution.levels[k].active[i], side) << k << ", " << i;
        }
        if (row.norm() == 0) {
          EXPECT_EQ(solution.levels[k].active[i], Side::kNone);
        } else if (solution.levels[k].active[i] == Side::kUpper) {
          EXPECT_GE(above, -zero) << k << ", " << i;
        } else if (solution.levels[k].active[i] == Side::kLower) {
          EXPECT_GE(below, -zero) << k << ", " << i;
        }
      }
      const Eigen::VectorXd none = Eigen::VectorXd::Zero(rows.rows());
      const Eigen::VectorXd weight = Eigen::VectorXd::Ones(rows.rows());
      EXPECT_EQ(solution.levels[k].nullity,
                n - SolveLexicographically(n, {{rows, none, weight}}).rank[0])
          << k;
    }
  }
}

// Costs are equal to the bit: the cost of a level does not depend on the levels
// below, and no threshold is absolute.
TEST_P(EitherCascadeTest, KeepsCostsInAnyUnit) {
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = Draw(seed);
    const Solution whole = SolveCascade(drawn, GetParam());
    const int levels = drawn.hierarchy.num_levels();
    for (int k = 1; k < levels; ++k) {
      const Solution part = SolveCascade(Part(drawn, k), GetParam());
      for (int above = 0; above < k; ++above) {
        EXPECT_EQ(part.levels[above].cost, whole.levels[above].cost);
      }
    }
    const double unit = std::ldexp(1, -80);
    const Solution small = SolveCascade(Part(drawn, levels, unit), GetParam());
    EXPECT_EQ(small.y, whole.y * unit);
    EXPECT_EQ(small.iterations, whole.iterations);
    for (int k = 0; k < levels; ++k) {
      EXPECT_EQ(small.levels[k].nullity, whole.levels[k].nullity);
      EXPECT_EQ(small.levels[k].active, whole.levels[k].active);
    }
  }
}

// Only the last levels remain unsolved. They are evaluated at the returned y.
TEST_P(EitherCascadeTest, DoesNotExceedItsBudget) {
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = Draw(seed);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    const int needed = SolveCascade(drawn, GetParam()).iterations;
    EXPECT_GT(needed, hierarchy.num_levels());
    int failed_before = 0;
    for (int budget = 0; budget <= needed; ++budget) {
      Cascade cascade(n, drawn.capacity, GetParam());
      cascade.max_iterations = budget;
      Solution solution(n, drawn.capacity);
      const Status status = cascade.Solve(hierarchy, &solution);
      EXPECT_EQ(status, solution.status);
      EXPECT_EQ(solution.iterations, budget);
      EXPECT_LE(
          Certifier(n, drawn.capacity).Certify(hierarchy, solution).worst(),
          kCertified);
      if (budget == needed) {
        EXPECT_EQ(status, Status::kOptimal);
        EXPECT_EQ(solution.failed_level, -1);
        continue;
      }
      EXPECT_EQ(status, Status::kIterationLimit);
      EXPECT_GE(solution.failed_level, failed_before);
      EXPECT_LE(solution.failed_level, hierarchy.num_levels());
      failed_before = solution.failed_level;
      for (int k = failed_before; k < hierarchy.num_levels(); ++k) {
        Solution evaluated = solution;
        EvaluateLevel(hierarchy, k, &evaluated);
        EXPECT_EQ(solution.levels[k].cost, evaluated.levels[k].cost);
        EXPECT_EQ(solution.levels[k].slack, evaluated.levels[k].slack);
      }
    }
    // Only the norm of y is not minimised.
    EXPECT_EQ(failed_before, hierarchy.num_levels());
  }
}

// Rows of very different norms may hide an error from the cascade, but not from
// the certificate.
TEST_P(EitherCascadeTest, ReportsOnlyCertifiedAnswersAsOptimal) {
  RandomHierarchyOptions options;
  options.scaled = 100;
  int optimal = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    Solution solution(n, drawn.capacity);
    const Status status = Cascade(n, drawn.capacity, GetParam())
                              .Solve(drawn.hierarchy, &solution);
    EXPECT_EQ(status, solution.status);
    EXPECT_EQ(status == Status::kOptimal, solution.failed_level < 0);
    EXPECT_LE(
        Certifier(n, drawn.capacity).Certify(drawn.hierarchy, solution).worst(),
        Certifier::kCertified);
    optimal += status == Status::kOptimal;
  }
  EXPECT_GE(optimal, 290) << "optimal answers of 300";
}

INSTANTIATE_TEST_SUITE_P(BothWays, EitherCascadeTest,
                         testing::Values(RowSpaceMethod::kSvd,
                                         RowSpaceMethod::kCod));

}  // namespace
}  // namespace poise
