// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/solver.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/tests/util/copy_level.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-14;  // A few operations on numbers near 1.
constexpr double kCertified = Certifier::kCertified;

TEST(Solver, AgreesWithTheCascade) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  int iterations = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& hierarchy = drawn.hierarchy;
    const int n = hierarchy.num_variables();
    Cascade cascade(n, drawn.capacity);
    Solver solver(n, drawn.capacity);
    Certifier certifier(n, drawn.capacity);
    Solution reference(n, drawn.capacity), solution(n, drawn.capacity);
    ASSERT_EQ(cascade.Solve(hierarchy, &reference), Status::kOptimal);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    iterations += solution.iterations;
    EXPECT_LE(certifier.Certify(hierarchy, reference).worst(), kCertified);
    EXPECT_LE(certifier.Certify(hierarchy, solution).worst(), kCertified);
    for (int level = 0; level < hierarchy.num_levels(); ++level) {
      EXPECT_NEAR(solution.levels[level].cost, reference.levels[level].cost,
                  kCertified * CostSize(hierarchy, level, reference));
      EXPECT_EQ(solution.levels[level].nullity,
                reference.levels[level].nullity);
    }
    CountMalloc count;
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_EQ(count.allocations(), 0);
    EXPECT_LE(solution.iterations, 2);
  }
  // Later steps correct a wrong step, so a wrong step shows only in the number
  // of steps. This number is 1216; rounding may change it by a few.
  EXPECT_LE(iterations, 1220);
}

// Returns the hierarchy with zeros before and after a random part of each row.
HierarchyCase WithShortRows(const HierarchyCase& drawn, std::uint64_t seed) {
  const Hierarchy& from = drawn.hierarchy;
  const int n = from.num_variables();
  HierarchyCase result{drawn.capacity, Hierarchy(n, drawn.capacity)};
  result.hierarchy.Clear(from.num_levels());
  std::mt19937_64 numbers(seed);
  const auto shorten = [&](auto rows) {
    for (int i = 0; i < rows.rows(); ++i) {
      const auto first = static_cast<Eigen::Index>(numbers() % n);
      rows.row(i).head(first).setZero();
      rows.row(i)
          .tail((n - first) / (1 + static_cast<int>(numbers() % 2)) / 2)
          .setZero();
    }
  };
  for (int k = 0; k < from.num_levels(); ++k) {
    const LevelBlocks rows = CopyLevel(from, k, &result.hierarchy);
    shorten(rows.equalities.B);
    shorten(rows.inequalities.C);
  }
  return result;
}

// Spans tell which entries are zero, and so must not change an answer.
TEST(Solver, SkipsZerosOutsideTheSpansOfRows) {
  int short_rows = 0;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    HierarchyCase drawn =
        WithShortRows(MakeRandomHierarchy(seed, {.scaled = 0}), seed);
    const Hierarchy without = drawn.hierarchy;
    const Hierarchy& hierarchy = drawn.hierarchy;
    drawn.hierarchy.FindSpans();
    const int n = hierarchy.num_variables();
    Solver solver(n, drawn.capacity), other(n, drawn.capacity);
    Certifier certifier(n, drawn.capacity);
    Solution solution(n, drawn.capacity), expected(n, drawn.capacity);
    ASSERT_EQ(other.Solve(without, &expected), Status::kOptimal);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_LE(certifier.Certify(without, solution).worst(), kCertified);
    EXPECT_LE(certifier.Certify(hierarchy, expected).worst(), kCertified);
    for (int level = 0; level < hierarchy.num_levels(); ++level) {
      EXPECT_NEAR(solution.levels[level].cost, expected.levels[level].cost,
                  kCertified * CostSize(without, level, expected));
      for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
        short_rows += hierarchy.B_span(level)[i].size < n;
      }
    }
  }
  EXPECT_GT(short_rows, 200);
}

// Level 0: y0 <= 1 and y1 >= 2. Level 1: y0 + y1 = 4. Level 2: y = (5, 0). The
// optimum is y = (1, 3).
class SolverTest : public testing::Test {
 protected:
  SolverTest() {
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
    sum_ = sum.b.data();
    bounds_lower_ = bounds.lower.data();
    bounds_upper_ = bounds.upper.data();
    weight_ = target.weight.data();
    C_ = bounds.C.data();
  }

  const std::vector<LevelCapacity> capacity_{{0, 2}, {1, 0}, {2, 0}};
  Hierarchy hierarchy_{2, capacity_};
  double *sum_, *bounds_lower_, *bounds_upper_, *weight_, *C_;
  Solver solver_{2, capacity_};
  Solution solution_{2, capacity_};
};

TEST_F(SolverTest, SolvesByHand) {
  ASSERT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_NEAR(solution_.y[0], 1, kTolerance);
  EXPECT_NEAR(solution_.y[1], 3, kTolerance);
  EXPECT_EQ(solution_.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution_.levels[0].active[1], Side::kNone);
  EXPECT_EQ(solution_.levels[0].nullity, 2);
  EXPECT_EQ(solution_.levels[1].nullity, 1);
  EXPECT_EQ(solution_.levels[2].nullity, 0);
  EXPECT_NEAR(solution_.levels[2].multipliers[1].equality[0], -3,
              10 * kTolerance);
  EXPECT_NEAR(solution_.levels[2].multipliers[0].inequality[0], 7,
              10 * kTolerance);
}

TEST_F(SolverTest, StartsFromTheLastActiveSet) {
  ASSERT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_GT(solution_.iterations, 1);
  ASSERT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_EQ(solution_.iterations, 1);
  solver_.Forget();
  ASSERT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_GT(solution_.iterations, 1);
}

TEST_F(SolverTest, RemovesARowWithoutBounds) {
  ASSERT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
  bounds_upper_[0] = INFINITY;
  ASSERT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
  EXPECT_LE(solution_.iterations, 3);
  EXPECT_NEAR(solution_.y[0], 2, kTolerance);
  EXPECT_NEAR(solution_.y[1], 2, kTolerance);
}

TEST_F(SolverTest, ReportsNumbersThatAreNotFinite) {
  for (double* number : {sum_, weight_, C_}) {
    for (const double bad : {double(NAN), double(INFINITY)}) {
      const double good = *number;
      *number = bad;
      EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kNotFinite);
      EXPECT_EQ(solution_.failed_level, number == sum_      ? 1
                                        : number == weight_ ? 2
                                                            : 0);
      EXPECT_EQ(solution_.y, Eigen::Vector2d(0, 0));
      *number = good;
    }
  }
  bounds_upper_[0] = NAN;
  EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kNotFinite);
  bounds_upper_[0] = 1;
  bounds_lower_[1] = INFINITY;
  EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kNotFinite);
}

TEST_F(SolverTest, ReportsBadInput) {
  bounds_lower_[0] = 1.5;  // Above upper = 1.
  EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kBadInput);
  EXPECT_EQ(solution_.failed_level, 0);
  bounds_lower_[0] = -1;
  weight_[1] = -1;
  EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kBadInput);
  EXPECT_EQ(solution_.failed_level, 2);
}

// Numbers whose squares overflow do not enter the search, and the next solves
// are those of a solver that has never seen them.
TEST(Solver, RefusesRowsWhoseSquaresOverflow) {
  const std::vector<LevelCapacity> capacity = {{1, 1}, {2, 0}};
  const auto make = [&](double of_B, double of_C, double weight) {
    Hierarchy hierarchy(2, capacity);
    EqualityBlock equality = hierarchy.AddEqualities(0, 1);
    equality.B << 0.7 * of_B, 2 * of_B;
    equality.b << of_B;
    equality.weight << weight;
    InequalityBlock bound = hierarchy.AddInequalities(0, 1);
    bound.C << of_C, -of_C;
    bound.upper << of_C / 3;
    hierarchy.AddEqualities(1, 2).B.setIdentity();
    return hierarchy;
  };
  const Hierarchy usual = make(1, 1, 1);
  Solution solution(2, capacity), expected(2, capacity);
  ASSERT_EQ(Solver(2, capacity).Solve(usual, &expected), Status::kOptimal);
  const Hierarchy refused[] = {make(1e160, 1, 1), make(1, 1e160, 1),
                               make(1e100, 1, 1e120)};
  for (const Hierarchy& hierarchy : refused) {
    Solver solver(2, capacity);
    solver.max_modelled_seconds = 1e-9;
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kNotFinite);
    EXPECT_EQ(solution.failed_level, 0);
    EXPECT_TRUE(solution.y.isZero(0));
    int failed_level;
    EXPECT_EQ(CheckInput(hierarchy, &failed_level), Status::kNotFinite);
    EXPECT_EQ(failed_level, 0);
    solver.max_modelled_seconds = 0;
    EXPECT_EQ(solver.Solve(usual, &solution), Status::kOptimal);
    EXPECT_EQ(solution.y, expected.y);
  }
  EXPECT_EQ(Solver(2, capacity).Solve(make(1e140, 1e140, 1), &solution),
            Status::kOptimal);
}

// The status does not depend on the order of the rows, and is that of
// CheckInput().
TEST(Solver, ReportsNanBeforeCrossedBounds) {
  const std::vector<LevelCapacity> capacity = {{0, 2}};
  for (const int crossed : {0, 1}) {
    Hierarchy hierarchy(1, capacity);
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C << 1, 1;
    bounds.lower << 0, 0;
    bounds.upper << 1, 1;
    bounds.upper[crossed] = -1;
    bounds.upper[1 - crossed] = std::numeric_limits<double>::quiet_NaN();
    Solution solution(1, capacity);
    int failed_level;
    EXPECT_EQ(Solver(1, capacity).Solve(hierarchy, &solution),
              Status::kNotFinite);
    EXPECT_EQ(CheckInput(hierarchy, &failed_level), Status::kNotFinite);
  }
}

// A target can overflow as well. The next solve is then that of a new solver.
TEST(Solver, ForgetsASearchThatOverflows) {
  const std::vector<LevelCapacity> capacity = {{1, 2}, {2, 0}};
  const auto make = [&](double target) {
    Hierarchy hierarchy(2, capacity);
    EqualityBlock equality = hierarchy.AddEqualities(0, 1);
    equality.B << 0.1, 0.2;
    equality.b << target;
    InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
    bounds.C.setIdentity();
    bounds.lower << -1, -1;
    bounds.upper << 1, 1;
    hierarchy.AddEqualities(1, 2).B.setIdentity();
    return hierarchy;
  };
  const Hierarchy usual = make(0.35), too_large = make(1.7e308);
  Solution solution(2, capacity), expected(2, capacity);
  ASSERT_EQ(Solver(2, capacity).Solve(usual, &expected), Status::kOptimal);
  Solver solver(2, capacity);
  ASSERT_EQ(solver.Solve(usual, &solution), Status::kOptimal);
  EXPECT_EQ(solver.Solve(too_large, &solution), Status::kNotFinite);
  EXPECT_TRUE(solution.y.isZero(0));
  EXPECT_EQ(solution.failed_level, 0);
  EXPECT_EQ(solver.Solve(usual, &solution), Status::kOptimal);
  EXPECT_EQ(solution.y, expected.y);
  EXPECT_EQ(solution.iterations, expected.iterations);
  // The cascade judges alike.
  EXPECT_EQ(Cascade(2, capacity).Solve(too_large, &solution),
            Status::kNotFinite);
  EXPECT_TRUE(solution.y.isZero(0));
  EXPECT_EQ(solution.failed_level, 0);
}

// 1e-17 y_1 is 1 at y_1 = 1e17, though 1 + 1e-17 is 1: the second level has two
// variables.
TEST(Solver, ATinyEntryBesideALargeOneCounts) {
  const std::vector<LevelCapacity> capacity = {{1, 0}, {1, 0}};
  Hierarchy hierarchy(2, capacity);
  EqualityBlock first = hierarchy.AddEqualities(0, 1);
  first.B << 0, 1;
  first.b << -1e17;
  EqualityBlock second = hierarchy.AddEqualities(1, 1);
  second.B << 1, 1e-17;
  second.b << -3;
  Solution solution(2, capacity);
  EXPECT_EQ(Solver(2, capacity).Solve(hierarchy, &solution), Status::kOptimal);
  EXPECT_NEAR(solution.y[0], 2, 1e-14);  // A few roundings of numbers near 1.
}

// A row that is too small to count leaves its level diagonal. So it takes no
// memory of the leading levels, and the answer does not depend on the solver's
// past.
TEST(Solver, LeavesATinyRowOutOfADiagonalLevel) {
  const std::vector<LevelCapacity> capacity = {{0, 1}, {2, 0}};
  constexpr int kMaxLeadingRows = 2;
  const auto make = [&](int column, double entry, double weight) {
    Hierarchy hierarchy(2, capacity);
    InequalityBlock bound = hierarchy.AddInequalities(0, 1);
    bound.C << 1, 1;
    bound.upper << -1;
    EqualityBlock targets = hierarchy.AddEqualities(1, 2);
    targets.B(0, column) = entry;
    targets.B(1, 1) = 0.3;
    targets.b << 0, -7;
    targets.weight << weight, 0.7;
    return hierarchy;
  };
  Solution without(2, capacity);
  ASSERT_EQ(Solver(2, capacity).Solve(make(0, 0, 1), &without),
            Status::kOptimal);
  const std::pair<double, double> rows[] = {
      {1e-160, 1}, {1, 1e-310}, {1e-100, 1e-110}};
  for (const auto& [entry, weight] : rows) {
    Solver living(2, capacity, kMaxLeadingRows);
    Solution solution(2, capacity);
    for (const int column : {1, 0}) {  // The first one is what it remembers.
      SCOPED_TRACE(column);
      living.Forget();
      EXPECT_EQ(living.Solve(make(column, entry, weight), &solution),
                Status::kOptimal);
      EXPECT_EQ(solution.y, without.y);
    }
    EXPECT_EQ(living.Solve(make(1, 1, 1), &solution), Status::kOptimal);
    living.Forget();
    EXPECT_EQ(living.Solve(make(0, entry, weight), &solution),
              Status::kOptimal);
    EXPECT_EQ(solution.y, without.y);
  }
}

TEST_F(SolverTest, RejectsAHierarchyBeyondItsCapacity) {
  const auto refuses = [&](int num_variables,
                           const std::vector<LevelCapacity>& capacity,
                           int failed_level) {
    Hierarchy larger(num_variables, capacity);
    for (int level = 0; level < static_cast<int>(capacity.size()); ++level) {
      (void)larger.AddEqualities(level, capacity[level].equalities);
      (void)larger.AddInequalities(level, capacity[level].inequalities);
    }
    EXPECT_EQ(solver_.Solve(larger, &solution_), Status::kBadInput);
    EXPECT_EQ(solution_.failed_level, failed_level);
  };
  refuses(3, capacity_, 0);
  std::vector<LevelCapacity> capacity = capacity_;
  capacity.push_back({1, 0});
  refuses(2, capacity, static_cast<int>(capacity_.size()));
  for (const int level : {0, 1, 2}) {
    capacity = capacity_;
    ++capacity[level].equalities;
    refuses(2, capacity, level);
    capacity = capacity_;
    ++capacity[level].inequalities;
    refuses(2, capacity, level);
  }
}

// Only the last levels remain unsolved if the budget is spent. The levels above
// them are certified.
TEST_F(SolverTest, CertifiesLevelsSolvedWithinTheBudget) {
  Certifier certifier(2, capacity_);
  int truncated = 0;
  for (int budget = 1; budget < 12; ++budget) {
    SCOPED_TRACE(budget);
    solver_.Forget();
    solver_.max_iterations = budget;
    const Status status = solver_.Solve(hierarchy_, &solution_);
    EXPECT_EQ(status, solution_.status);
    EXPECT_LE(solution_.iterations, budget);
    EXPECT_LE(certifier.Certify(hierarchy_, solution_).worst(), kTolerance);
    if (status == Status::kOptimal) continue;
    EXPECT_EQ(status, Status::kIterationLimit);
    ASSERT_GE(solution_.failed_level, 0);
    ++truncated;
  }
  EXPECT_GT(truncated, 0);
  EXPECT_EQ(solution_.status, Status::kOptimal);
}

TEST_F(SolverTest, StopsAtItsTimeLimit) {
  double time = 0;
  solver_.now = [&time] { return time += 1; };
  solver_.max_seconds = 0.5;
  EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kIterationLimit);
  EXPECT_EQ(solution_.iterations, 2);
  solver_.max_seconds = 1000;
  EXPECT_EQ(solver_.Solve(hierarchy_, &solution_), Status::kOptimal);
}

// Two parallel large-norm rows conflict. A small-norm row of another direction
// on the same level is met to rounding of its own terms, not of those of the
// large-norm rows.
TEST(Solver, MeetsASmallRowBesideAConflict) {
  const std::vector<LevelCapacity> capacity{{3, 0}};
  for (int place = 0; place < 3; ++place) {
    for (const double factor : {1.0, -2.0}) {
      Hierarchy hierarchy(2, capacity);
      EqualityBlock rows = hierarchy.AddEqualities(0, 3);
      for (int i = 0; i < 3; ++i) rows.B.row(i) << 28400, 17700;
      rows.B.row(place) << 0, 0.0052;
      const int last = place == 2 ? 1 : 2;
      rows.B.row(last) *= factor;
      rows.b[last] = 53392;
      Solution solution(2, capacity);
      ASSERT_EQ(Solver(2, capacity).Solve(hierarchy, &solution),
                Status::kOptimal);
      EXPECT_NEAR(solution.y[0],
                  -53392 * factor / (1 + factor * factor) / 28400,
                  Rounding(1, 3));
      EXPECT_NEAR(solution.y[1], 0, Rounding(1, 3)) << place;
    }
  }
}

// Rows of very different norms may hide an error from the search, but not from
// the certificate.
TEST(Solver, ReportsOnlyCertifiedAnswersAsOptimal) {
  RandomHierarchyOptions options;
  options.scaled = 100;
  int optimal = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const int n = drawn.hierarchy.num_variables();
    Certifier certifier(n, drawn.capacity);
    Solution solution(n, drawn.capacity);
    optimal += Solver(n, drawn.capacity).Solve(drawn.hierarchy, &solution) ==
               Status::kOptimal;
    EXPECT_LE(certifier.Certify(drawn.hierarchy, solution).worst(), kCertified);
  }
  EXPECT_GE(optimal, 290);  // 292 are optimal.
}

// A lower level never changes an upper one's optimum.
TEST(Solver, KeepsTheOptimumOfUpperLevels) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
    const Hierarchy& all = drawn.hierarchy;
    const int n = all.num_variables(), levels = all.num_levels() - 1;
    Hierarchy upper(n, drawn.capacity);
    upper.Clear(levels);
    for (int level = 0; level < levels; ++level) {
      CopyLevel(all, level, &upper);
    }
    Solver solver(n, drawn.capacity);
    Solution whole(n, drawn.capacity), part(n, drawn.capacity);
    ASSERT_EQ(solver.Solve(all, &whole), Status::kOptimal);
    ASSERT_EQ(solver.Solve(upper, &part), Status::kOptimal);
    for (int level = 0; level < levels; ++level) {
      EXPECT_NEAR(whole.levels[level].cost, part.levels[level].cost,
                  kCertified * (CostSize(all, level, whole) +
                                CostSize(all, level, part)));
      EXPECT_EQ(whole.levels[level].nullity, part.levels[level].nullity);
    }
  }
}

// The first level has no active row, and the second contradicts itself. The row
// y0 <= 4 becomes active, so that the factorisation is updated. Nothing of the
// last solve may be left in it.
TEST(Solver, ForgetsTheRowsOfTheLastSolve) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {2, 2}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  Solver solver(2, capacity);
  Solution solution(2, capacity);
  for (int solve = 0; solve < 4; ++solve) {
    SCOPED_TRACE(solve);
    // By turns, the direction of the contradiction is y0 and y1.
    const int j = solve % 2;
    hierarchy.Clear(3);
    InequalityBlock wide = hierarchy.AddInequalities(0, 1);
    wide.C << 1, 1;
    wide.upper << 100;
    EqualityBlock both = hierarchy.AddEqualities(1, 2);
    both.B.col(j).setOnes();
    both.b << -2, -8;
    InequalityBlock least = hierarchy.AddInequalities(1, 2);
    least.C.setIdentity();
    least.upper[j] = 4;
    least.upper[1 - j] = solve < 2 ? 4 : 100;
    EqualityBlock target = hierarchy.AddEqualities(2, 2);
    target.B.setIdentity();
    target.b << -9, -9;
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    // Level 1 minimises (x - 2)^2 + (x - 8)^2 + max(0, x - 4)^2: x = 14 / 3.
    EXPECT_NEAR(solution.y[j], 14. / 3, kTolerance);
    EXPECT_NEAR(solution.y[1 - j], solve < 2 ? 4 : 9, kTolerance);
  }
}

// After Forget(), a solver does not know which levels another problem has met.
// The equality of one variable would else be factored first.
TEST(Solver, RepeatsBitForBitAfterForget) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.degenerate = 60;
  options.bounds = 60;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyCase drawn =
        WithRoomToChange(MakeRandomHierarchy(seed, options));
    HierarchyCase changed = drawn;
    ChangeHierarchy(seed, &changed);
    const int n = drawn.hierarchy.num_variables();
    Solver living(n, drawn.capacity), fresh(n, drawn.capacity);
    Solution first(n, drawn.capacity), again(n, drawn.capacity);
    (void)living.Solve(drawn.hierarchy, &first);
    (void)living.Solve(changed.hierarchy, &first);
    living.Forget();
    (void)living.Solve(drawn.hierarchy, &again);
    (void)fresh.Solve(drawn.hierarchy, &first);
    EXPECT_EQ(again.y, first.y);
    EXPECT_EQ(living.modelled_seconds(), fresh.modelled_seconds());
  }
}

// A search that is cut off may just have removed a row. A search that starts
// later must not take this row for one that it has removed itself.
TEST(Solver, RepeatsBitForBitAfterASearchThatWasCutOff) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
  bounds.C << 1, 0, 1, 1;
  bounds.upper << 0, 1;
  EqualityBlock target = hierarchy.AddEqualities(1, 2);
  target.B << 1, 1, 1, -1;
  target.b << -6, 4;  // y = (1, 5).
  Solver fresh(2, capacity);
  Solution expected(2, capacity), solution(2, capacity);
  ASSERT_EQ(fresh.Solve(hierarchy, &expected), Status::kOptimal);
  ASSERT_GT(expected.iterations, 4);
  for (int limit = 1; limit < expected.iterations; ++limit) {
    SCOPED_TRACE(limit);
    Solver solver(2, capacity);
    const int most = solver.max_iterations;
    solver.max_iterations = limit;
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kIterationLimit);
    solver.max_iterations = most;
    solver.Forget();
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_EQ(solution.iterations, expected.iterations);
    EXPECT_EQ(solution.y, expected.y);
  }
}

// No y changes the violation of a row of zeros, so that the search leaves it
// alone.
TEST(Solver, ARowOfZerosThatCannotBeMetTakesNoIteration) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {2, 0}};
  int iterations[2] = {};
  for (const bool has_zeros : {false, true}) {
    Hierarchy hierarchy(2, capacity);
    InequalityBlock rows = hierarchy.AddInequalities(0, 2);
    rows.C(0, 0) = 1;
    rows.upper << 1, (has_zeros ? -1 : 1);
    EqualityBlock target = hierarchy.AddEqualities(1, 2);
    target.B.setIdentity();
    target.b << -3, -2;
    Solver solver(2, capacity);
    Solution solution(2, capacity);
    EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_EQ(solution.y, Eigen::Vector2d(1, 2));
    EXPECT_EQ(solution.levels[0].slack[1], has_zeros ? 1 : 0);
    EXPECT_EQ(solution.levels[0].active[1], Side::kNone);
    iterations[has_zeros ? 1 : 0] = solution.iterations;
  }
  EXPECT_EQ(iterations[1], iterations[0]);
}

TEST(Solver, SolvesAHierarchyWithoutVariables) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 0}};
  Hierarchy hierarchy(0, capacity);
  hierarchy.AddEqualities(0, 1).b << 3;
  hierarchy.AddInequalities(0, 1).upper << -2;
  hierarchy.AddEqualities(1, 1).b << 1;
  for (const double seconds : {0.0, 1e-3}) {
    Solver solver(0, capacity);
    solver.max_modelled_seconds = seconds;
    Solution solution(0, capacity);
    for (int tick = 0; tick < 2; ++tick) {
      EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
      EXPECT_EQ(solution.levels[0].cost, (3 * 3 + 2 * 2) / 2.0);
      EXPECT_EQ(solution.levels[1].cost, 0.5);
      EXPECT_EQ(solution.certificate.worst(), 0);
    }
  }
}

TEST(Solver, TheShortestYSolvesAHierarchyWithoutLevels) {
  const Hierarchy hierarchy(3, {});
  for (const double seconds : {0.0, 1e-3}) {
    Solver solver(3, {});
    solver.max_modelled_seconds = seconds;
    Solution solution(3, {});
    for (int tick = 0; tick < 2; ++tick) {
      EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
      EXPECT_EQ(solution.y, Eigen::VectorXd::Zero(3));
    }
  }
}

// The row is 2 y0 <= 2, and y1 is 1e8. The rounding of y1 hides violations
// below 1e-3 from the search. Refinement finds such a violation and adds the
// row, unless the violation is rounding of 2 |y0| + 2.
TEST(Solver, AddsRowsThatOnlyRefinementFindsViolated) {
  const std::vector<LevelCapacity> capacity{{0, 3}, {0, 3}, {2, 0}};
  const double rounding = 100 * std::numeric_limits<double>::epsilon() * 4;
  for (const int level : {0, 1}) {
    for (const int at : {0, 2}) {
      for (const double sign : {-1.0, 1.0}) {
        for (const bool is_upper : {false, true}) {
          for (const double violation :
               {0., 1e-15, rounding, 1e-9, 1e-6, 1e-3, 1e-1}) {
            SCOPED_TRACE(testing::Message()
                         << level << at << sign << " " << violation);
            Hierarchy hierarchy(3, capacity);
            for (int k = 0; k < 2; ++k) {
              InequalityBlock rows = hierarchy.AddInequalities(k, 3);
              rows.C.col(2).setConstant(5);
              rows.lower.setConstant(-10);
              rows.upper.setConstant(10);
              if (k != level) continue;
              rows.C.row(at) << 2 * sign, 0, 0;
              rows.lower[at] = is_upper ? -INFINITY : -2;
              rows.upper[at] = is_upper ? 2 : INFINITY;
            }
            const double out = is_upper ? sign : -sign;
            EqualityBlock targets = hierarchy.AddEqualities(2, 2);
            targets.B << 1, 0, 0, 0, 1, 0;
            targets.b << -out * (1 + violation / 2), -1e8;
            Solution solution(3, capacity);
            ASSERT_EQ(Solver(3, capacity).Solve(hierarchy, &solution),
                      Status::kOptimal);
            const Side side = is_upper ? Side::kUpper : Side::kLower;
            const bool is_rounding = violation <= rounding;
            EXPECT_EQ(solution.levels[level].active[at],
                      is_rounding ? Side::kNone : side);
            EXPECT_EQ(solution.y[0], is_rounding ? -targets.b[0] : out);
            EXPECT_EQ(solution.y[1], 1e8);
            EXPECT_LE(solution.certificate.worst(), kCertified);
          }
        }
      }
    }
  }
}

// Level 0: y0 + y1 >= 0. Level 1: y0 = desired. y has minimum norm, also if the
// row was active in the previous solve.
TEST(Solver, RemovesARowForTheNormAlone) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {1, 0}};
  Solver solver(2, capacity);
  for (const double desired : {-1., 1., 2., -2.}) {
    Hierarchy hierarchy(2, capacity);
    InequalityBlock row = hierarchy.AddInequalities(0, 1);
    row.C << 1, 1;
    row.lower << 0;
    EqualityBlock equality = hierarchy.AddEqualities(1, 1);
    equality.B << 1, 0;
    equality.b << -desired;
    Solution solution(2, capacity);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
    EXPECT_NEAR(solution.y[0], desired, kTolerance);
    EXPECT_NEAR(solution.y[1], std::max(-desired, 0.), kTolerance);
  }
}

TEST(Solver, FillsTheCertificateOfItsAnswer) {
  for (int seed = 0; seed < 100; ++seed) {
    const HierarchyCase drawn = MakeRandomHierarchy(seed);
    const int n = drawn.hierarchy.num_variables();
    Certifier certifier(n, drawn.capacity);
    for (const int max_iterations : {2, 500}) {
      Solver solver(n, drawn.capacity);
      solver.max_iterations = max_iterations;
      Solution solution(n, drawn.capacity);
      solution.certificate.stationarity = 1;
      (void)solver.Solve(drawn.hierarchy, &solution);
      const Certificate expected = certifier.Certify(drawn.hierarchy, solution);
      const Certificate& certificate = solution.certificate;
      EXPECT_EQ(certificate.stationarity, expected.stationarity) << seed;
      EXPECT_EQ(certificate.feasibility, expected.feasibility) << seed;
      EXPECT_EQ(certificate.complementarity, expected.complementarity) << seed;
      EXPECT_EQ(certificate.priority, expected.priority) << seed;
    }
  }
}

// The level above the invalid one has valid numbers, and y = 0 is not its
// optimum.
TEST(Solver, CertifiesNoAnswerToBadInput) {
  Hierarchy hierarchy(1, {{1, 0}, {1, 0}});
  EqualityBlock first = hierarchy.AddEqualities(0, 1);
  first.B << 1;
  first.b << -2;
  EqualityBlock second = hierarchy.AddEqualities(1, 1);
  second.B << std::numeric_limits<double>::quiet_NaN();
  second.b << 0;
  Solver solver(1, {{1, 0}, {1, 0}});
  Solution solution(1, {{1, 0}, {1, 0}});
  EXPECT_EQ(solver.Solve(hierarchy, &solution), Status::kNotFinite);
  EXPECT_EQ(solution.failed_level, 1);
  EXPECT_GT(solution.certificate.worst(), 0.1);
}

// The content of newly allocated memory has no effect, so that a replay gives
// the same bits.
TEST(Solver, DoesNotReadUninitialisedMemory) {
  RandomHierarchyOptions options;
  options.planted = 100;
  const HierarchyCase drawn = MakeRandomHierarchy(3467, options);
  const int n = drawn.hierarchy.num_variables();
  std::vector<Solution> solutions(2, Solution(n, drawn.capacity));
  for (const int fill : {0, 0xff}) {
    // The C library fills new memory with the complement of this byte.
    mallopt(M_PERTURB, fill == 0 ? 0xff : 1);
    Solver solver(n, drawn.capacity);
    mallopt(M_PERTURB, 0);
    Solution& solution = solutions[fill == 0 ? 0 : 1];
    EXPECT_EQ(solver.Solve(drawn.hierarchy, &solution), Status::kOptimal);
  }
  EXPECT_EQ(solutions[0].y, solutions[1].y);
  EXPECT_EQ(solutions[0].iterations, solutions[1].iterations);
}

}  // namespace
}  // namespace poise
