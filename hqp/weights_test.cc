// Very different weights on one level.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

void ExpectSameOptimum(int seed, const RandomHierarchyOptions& options) {
  SCOPED_TRACE(seed);
  const HierarchyCase drawn = MakeRandomHierarchy(seed, options);
  const Hierarchy& hierarchy = drawn.hierarchy;
  const int n = hierarchy.num_variables();
  Solution reference(n, drawn.capacity), solution(n, drawn.capacity);
  ASSERT_EQ(Cascade(n, drawn.capacity).Solve(hierarchy, &reference),
            Status::kOptimal);
  ASSERT_EQ(Solver(n, drawn.capacity).Solve(hierarchy, &solution),
            Status::kOptimal);
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    EXPECT_NEAR(solution.levels[level].cost, reference.levels[level].cost,
                Certifier::kCertified * CostSize(hierarchy, level, reference));
  }
}

// The first seeds of `hqp_night --scaled 0 --weighted 100`, and regression
// seeds. With some seeds of the first list, a certified answer was wrong. With
// the other regression seeds, no optimum was found.
class WeightsTest : public testing::TestWithParam<int> {
 protected:
  std::vector<int> Seeds() const {
    std::vector<int> seeds;
    if (GetParam() == 4) seeds = {6727, 11305, 10166, 14829, 16148};
    if (GetParam() == 6) {
      seeds = {2051,  2423,  3679,  5295,  10200,
               10225, 10489, 13676, 15814, 16737};
    }
    if (GetParam() == 8) {
      seeds = {138, 280, 303, 358, 624, 768, 863, 1266, 1378, 1792, 1899, 1931};
    }
    // At seed 94, with weights over 16 decades, the solvers disagree.
    for (int seed = 1; seed < 94; ++seed) seeds.push_back(seed);
    return seeds;
  }
};

INSTANTIATE_TEST_SUITE_P(Decades, WeightsTest, testing::Values(4, 6, 8));

TEST_P(WeightsTest, GiveBothSolversTheSameOptimum) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.weighted = 100;
  options.decades = GetParam();
  for (const int seed : Seeds()) ExpectSameOptimum(seed, options);
}

// Three rows of level 0 fix both variables, whatever the weights on level 1.
TEST(Weights, DoNotChangeLevelsAbove) {
  const std::vector<LevelCapacity> capacity{{3, 0}, {2, 0}};
  Eigen::Matrix<double, 3, 2> A;
  A << 2.87, 0.41, -1.43, -1.66, 0, 1.35;
  const Eigen::Vector3d a(5.453, -3.1208, 2.673);
  const Eigen::Matrix2d normal = A.transpose() * A;
  const Eigen::Vector2d closest = normal.inverse() * A.transpose() * a;
  for (const double heavy : {1., 1e3, 1e6, 1e9, 1e12}) {
    for (int j = 0; j < 2; ++j) {
      Hierarchy hierarchy(2, capacity);
      EqualityBlock above = hierarchy.AddEqualities(0, 3);
      above.B = A;
      above.b = -a;
      EqualityBlock below = hierarchy.AddEqualities(1, 2);
      below.B.setIdentity();
      below.b << -1.55, -0.92;
      below.weight[j] = heavy;
      Solution solution(2, capacity);
      ASSERT_EQ(Solver(2, capacity).Solve(hierarchy, &solution),
                Status::kOptimal)
          << heavy << " on " << j;
      // The singular values of A are 3.4 and 2.0.
      EXPECT_LE((solution.y - closest).norm(), Rounding(closest.norm(), 3, 2))
          << heavy << " on " << j;
    }
  }
}

// Two parallel rows conflict on level 1, one of them with 1e7 times the weight.
// At their optimum, the gradient along the bound above is rounding of the
// residual of that row. So the bound is removed for level 2.
TEST(Weights, IgnoreRoundingOfALargeWeightRow) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {2, 0}, {1, 0}};
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const double bound = 0.1 * seed - 10;
    Solver solver(3, capacity);
    Solution solution(3, capacity);
    for (const double beyond : {5., -5.}) {
      Hierarchy hierarchy(3, capacity);
      InequalityBlock first = hierarchy.AddInequalities(0, 1);
      first.C.row(0) << 0, 1, 0;
      first.upper[0] = bound;
      EqualityBlock middle = hierarchy.AddEqualities(1, 2);
      middle.B.row(0) << 1, 0.3 + 0.01 * seed, 0.7;
      middle.B.row(1) = -2 * middle.B.row(0);
      middle.b << 0.3, 7 + 0.1 * seed;
      middle.weight << 1e-3, 1e4;
      EqualityBlock last = hierarchy.AddEqualities(2, 1);
      last.B.row(0) << 0, 1, 0;
      last.b[0] = -(bound + beyond);
      ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
      EXPECT_NEAR(solution.y[1], bound + std::min(beyond, 0.), Rounding(30, 3));
    }
    // One iteration with the row and one without; no search level by level.
    EXPECT_LE(solution.iterations, 3);
  }
}

// The units of the two variables differ by 1e6 and more, and both levels can be
// met. Neither variable is rounding error beside the other.
TEST(Weights, MeetRowsWithVariablesOfUnlikeUnits) {
  const std::vector<LevelCapacity> capacity{{0, 2}, {0, 1}};
  Hierarchy hierarchy(2, capacity);
  InequalityBlock first = hierarchy.AddInequalities(0, 2);
  first.C << -0.0009765625, 0, 0, -5242880;
  first.lower << 1, 0;
  InequalityBlock second = hierarchy.AddInequalities(1, 1);
  second.C << 0.00390625, -2097152;
  second.upper << -8;
  Solver solver(2, capacity);
  Solution solution(2, capacity);
  ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
  EXPECT_NEAR(solution.levels[0].cost, 0, 1e-20);
  EXPECT_NEAR(solution.levels[1].cost, 0, 1e-20);
}

// Regression seeds of `hqp_night --scaled 0 --columns 100`: variables have
// units from 1e-3 to 1e6. With the first seed, rounding of large-norm rows must
// not count as a multiplier. With the others, a multiplier much larger than its
// target must not count as rounding.
TEST(Weights, GiveBothSolversTheSameOptimumInAnyUnits) {
  RandomHierarchyOptions options;
  options.scaled = 0;
  options.columns = 100;
  for (const int seed : {398, 1676, 2941, 899, 1210, 1356, 1465, 2159, 2714}) {
    ExpectSameOptimum(seed, options);
  }
}

// The optimum is (0, -6/0.017). Level 1 fixes y0, so only y1 can meet the row.
// The coefficient of y1 in the row is small and the target of y1 is 0, so the
// multiplier is much larger than the target.
TEST(Weights, AllowAMultiplierLargerThanTheTarget) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {1, 0}, {1, 0}};
  Hierarchy hierarchy(2, capacity);
  InequalityBlock row = hierarchy.AddInequalities(0, 1);
  row.C << -226000, -0.017;
  row.lower[0] = 6;
  EqualityBlock first = hierarchy.AddEqualities(1, 1);
  first.B << 228000, 0;
  EqualityBlock last = hierarchy.AddEqualities(2, 1);
  last.B << 0, 0.01;
  Solver solver(2, capacity);
  Solution solution(2, capacity);
  ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
  EXPECT_EQ(solution.y[0], 0);
  EXPECT_NEAR(solution.y[1], -6 / 0.017, Rounding(6 / 0.017, 2));
  EXPECT_NEAR(solution.levels[2].multipliers[0].inequality[0],
              0.01 * 0.01 * 6 / 0.017 / -0.017, Rounding(2.1, 2));
}

}  // namespace
}  // namespace poise
