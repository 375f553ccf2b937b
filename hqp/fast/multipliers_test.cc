// Tests the multipliers, active sides and nullities of the fast solver, by hand
// and against the cascade.
#include "poise/hqp/fast/multipliers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/copy_level.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kTolerance = 1e-13;  // A few operations on numbers near 10.
constexpr double kCertified = 1e-10;  // A tenth of the solver's limit.

Solution Solve(const Hierarchy& hierarchy,
               const std::vector<LevelCapacity>& capacity) {
  Solution solution(hierarchy.num_variables(), capacity);
  EXPECT_EQ(
      Solver(hierarchy.num_variables(), capacity).Solve(hierarchy, &solution),
      Status::kOptimal);
  return solution;
}

// Returns the same hierarchy with a larger capacity.
HierarchyCase WithRoom(const HierarchyCase& drawn) {
  const Hierarchy& from = drawn.hierarchy;
  std::vector<LevelCapacity> capacity = drawn.capacity;
  for (LevelCapacity& level : capacity) {
    level.equalities += 2;
    level.inequalities += 1;
  }
  HierarchyCase result{capacity, Hierarchy(from.num_variables(), capacity)};
  for (int k = 0; k < from.num_levels(); ++k) {
    CopyLevel(from, k, &result.hierarchy);
  }
  return result;
}

// Hierarchies with and without diagonal levels. Few of them have multipliers of
// the wrong sign, so many hierarchies are needed to correct about a hundred of
// these.
TEST(MultiplierWriter, IsCertifiedAndHasTheNullityOfTheCascade) {
  for (int seed = 0; seed < 1200; ++seed) {
    SCOPED_TRACE(seed);
    RandomHierarchyOptions options;
    options.max_variables = 3 + seed % 4;
    options.max_equalities = 3;
    options.degenerate = 40;
    options.planted = 50;
    options.scaled = 0;
    options.selecting = seed % 2 == 0 ? 100 : 0;
    const HierarchyCase drawn = WithRoom(MakeRandomHierarchy(seed, options));
    const int n = drawn.hierarchy.num_variables();
    Solver solver(n, drawn.capacity);
    Solution solution(n, drawn.capacity), reference(n, drawn.capacity);
    ASSERT_EQ(Cascade(n, drawn.capacity).Solve(drawn.hierarchy, &reference),
              Status::kOptimal);
    EXPECT_LE(Certifier(n, drawn.capacity)
                  .Certify(drawn.hierarchy, reference)
                  .worst(),
              kCertified);
    for (int time = 0; time < 2; ++time) {
      ASSERT_EQ(solver.Solve(drawn.hierarchy, &solution), Status::kOptimal);
      EXPECT_LE(Certifier(n, drawn.capacity)
                    .Certify(drawn.hierarchy, solution)
                    .worst(),
                kCertified);
      for (int k = 0; k < drawn.hierarchy.num_levels(); ++k) {
        EXPECT_EQ(solution.levels[k].nullity, reference.levels[k].nullity) << k;
      }
    }
  }
}

// At y = 0 the row is at its bound and active, but not violated.
TEST(MultiplierWriter, AllowsARowOfSizeZero) {
  const std::vector<LevelCapacity> capacity{{0, 1}, {2, 0}};
  Hierarchy hierarchy(2, capacity);
  InequalityBlock row = hierarchy.AddInequalities(0, 1);
  row.C << 1, 0;
  row.upper << 0;
  EqualityBlock desired = hierarchy.AddEqualities(1, 2);
  desired.B << 1, 1, 1, -1;
  desired.b << -1, -1;
  const Solution solution = Solve(hierarchy, capacity);
  EXPECT_EQ(solution.y[0], 0);
  EXPECT_EQ(solution.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution.levels[0].nullity, 2);
}

// A row counts in the nullity, whatever its norm. Level 0: y0 = 1 and y1 <= 1.
// Level 1: y1 = 3. Level 2: y0 = 2 and y2 = 4.
TEST(MultiplierWriter, CountsSmallNormRowsInTheNullity) {
  const double length = std::ldexp(1, -43);  // 1e-13.
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 0}, {2, 0}};
  Hierarchy hierarchy(3, capacity);
  EqualityBlock row = hierarchy.AddEqualities(0, 1);
  row.B << length, 0, 0;
  row.b << -length;
  InequalityBlock bound = hierarchy.AddInequalities(0, 1);
  bound.C << 0, length, 0;
  bound.upper << length;
  EqualityBlock desired = hierarchy.AddEqualities(1, 1);
  desired.B << 0, 1, 0;
  desired.b << -3;
  EqualityBlock targets = hierarchy.AddEqualities(2, 2);
  targets.B << 1, 0, 0, 0, 0, 1;
  targets.b << -2, -4;
  const Solution solution = Solve(hierarchy, capacity);
  EXPECT_LE((solution.y - Eigen::Vector3d(1, 1, 4)).norm(), kTolerance);
  EXPECT_EQ(solution.levels[0].nullity, 2);
  EXPECT_EQ(solution.levels[1].nullity, 1);
  EXPECT_EQ(solution.levels[2].nullity, 0);
  EXPECT_NEAR(solution.levels[1].multipliers[0].inequality[0] * length, 2,
              kTolerance);
  EXPECT_NEAR(solution.levels[2].multipliers[0].equality[0] * length, 1,
              kTolerance);
}

// Diagonal levels: y = 0 on level 0, and 2 y = -0.5 on level 1. The gradient of
// level 1 is exactly 1. The multiplier of the row that fixes y cancels this
// gradient. Rows of weight zero have no multiplier.
TEST(MultiplierWriter, CancelsTheGradientOfADiagonalLevel) {
  const std::vector<LevelCapacity> capacity{{2, 0}, {2, 0}, {2, 0}};
  Hierarchy hierarchy(1, capacity);
  for (int k = 0; k < 3; ++k) {
    EqualityBlock desired = hierarchy.AddEqualities(k, 2);
    desired.B << 5, 1 + k;
    desired.b << 7, (k == 1 ? 0.5 : 0);
    desired.weight << 0, 1;
  }
  const Solution solution = Solve(hierarchy, capacity);
  EXPECT_EQ(solution.levels[1].multipliers[0].equality, Eigen::Vector2d(0, -1));
  for (int above = 0; above < 2; ++above) {
    EXPECT_EQ(solution.levels[2].multipliers[above].equality,
              Eigen::Vector2d(0, 0));
  }
}

// Two rows with lower = upper, y = 1 and y = 3. The optimum y = 2 is above the
// first bound and below the second. A row that is met is active at its upper
// bound.
TEST(MultiplierWriter, FindsTheViolatedSideOfEqualBounds) {
  const std::vector<LevelCapacity> capacity{{0, 2}};
  Hierarchy hierarchy(1, capacity);
  InequalityBlock rows = hierarchy.AddInequalities(0, 2);
  rows.C << 1, 1;
  rows.lower << 1, 3;
  rows.upper << 1, 3;
  const Solution torn = Solve(hierarchy, capacity);
  EXPECT_EQ(torn.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(torn.levels[0].active[1], Side::kLower);
  rows.lower << 2, 2;
  rows.upper << 2, 2;
  const Solution met = Solve(hierarchy, capacity);
  EXPECT_EQ(met.y[0], 2);
  EXPECT_EQ(met.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(met.levels[0].active[1], Side::kUpper);
}

// The rows 3 y0 + 4 y1 <= 50 and >= 50 + conflict. The optimum is near y = (10,
// 5), between the two bounds. A violated row counts in the nullity. A row that
// is violated by rounding only does not.
TEST(MultiplierWriter, CountsViolatedRowsInTheNullity) {
  for (const double conflict : {1e-15, 1e-12, 1e-9, 1e-5, 1e-2, 1.}) {
    SCOPED_TRACE(conflict);
    const std::vector<LevelCapacity> capacity{{1, 2}};
    Hierarchy hierarchy(2, capacity);
    EqualityBlock across = hierarchy.AddEqualities(0, 1);
    across.B << -4, 3;
    across.b << 25;
    InequalityBlock rows = hierarchy.AddInequalities(0, 2);
    rows.C << 3, 4, 3, 4;
    rows.upper[0] = 50;
    rows.lower[1] = 50 + conflict;
    const Solution solution = Solve(hierarchy, capacity);
    EXPECT_LE(solution.certificate.worst(), Certifier::kCertified);
    EXPECT_LE((solution.y - Eigen::Vector2d(10, 5)).norm(),
              conflict / 5 + Rounding(12, 2, 5));
    EXPECT_EQ(solution.levels[0].nullity, conflict <= 1e-9 ? 1 : 0);
  }
}

// Level 0: y0 = 1, y0 <= 1 - 2e-9 and y1 = 0. Level 1: y0 + y1 = 0. The
// inequality is at its bound within kAtBound, so its multiplier must not be
// negative. So the equalities of level 0 have the whole multiplier, in any
// unit.
TEST(MultiplierWriter, MovesTheMultiplierOffARowAtItsBound) {
  for (const double unit : {1., 1e-3}) {
    SCOPED_TRACE(unit);
    const std::vector<LevelCapacity> capacity{{2, 1}, {1, 0}};
    Hierarchy hierarchy(2, capacity);
    EqualityBlock targets = hierarchy.AddEqualities(0, 2);
    targets.B << 1, 0, 0, 1;
    targets.b << -unit, 0;
    InequalityBlock bound = hierarchy.AddInequalities(0, 1);
    bound.C << 1, 0;
    bound.upper << unit * (1 - 2e-9);
    EqualityBlock sum = hierarchy.AddEqualities(1, 1);
    sum.B << 1, 1;
    const Solution solution = Solve(hierarchy, capacity);
    EXPECT_EQ(solution.levels[0].active[0], Side::kUpper);
    EXPECT_EQ(solution.levels[0].nullity, 0);
    const LevelMultipliers& of_sum = solution.levels[1].multipliers[0];
    // The multiple is a quotient of residuals of 1e-9, which have seven digits.
    EXPECT_LE((of_sum.equality / unit - Eigen::Vector2d(-1, -1)).norm(), 1e-6);
    EXPECT_NEAR(of_sum.inequality[0] / unit, 0, 1e-6);
    EXPECT_LE(Certifier(2, capacity).Certify(hierarchy, solution).worst(),
              1e-9);
  }
}

// Level 0: y = 1 and y <= -1, with the optimum y = 0. Level 1: y = -5. Both
// rows of level 0 are equalities for level 1, and share its multiplier, which
// may have either sign.
TEST(MultiplierWriter, KeepsTheMultiplierOfAViolatedRow) {
  const std::vector<LevelCapacity> capacity{{1, 1}, {1, 0}};
  Hierarchy hierarchy(1, capacity);
  EqualityBlock desired = hierarchy.AddEqualities(0, 1);
  desired.B << 1;
  desired.b << -1;
  InequalityBlock bound = hierarchy.AddInequalities(0, 1);
  bound.C << 1;
  bound.upper << -1;
  EqualityBlock below = hierarchy.AddEqualities(1, 1);
  below.B << 1;
  below.b << 5;
  const Solution solution = Solve(hierarchy, capacity);
  const LevelMultipliers& multipliers = solution.levels[1].multipliers[0];
  EXPECT_NEAR(multipliers.equality[0], -2.5, kTolerance);
  EXPECT_NEAR(multipliers.inequality[0], -2.5, kTolerance);
}

// Level 0: y0 + y1 = 0. Level 1: y_j = 1. Level 2: y_(1-j) = 5. Level 3 is
// empty. The gradient of level 2 must not remain for level 3.
TEST(MultiplierWriter, ClearsTheGradientOfDiagonalLevels) {
  const std::vector<LevelCapacity> capacity{{1, 0}, {1, 0}, {1, 0}, {1, 0}};
  Solver solver(2, capacity);
  for (int j = 0; j < 2; ++j) {
    Hierarchy hierarchy(2, capacity);
    hierarchy.AddEqualities(0, 1).B << 1, 1;
    EqualityBlock first = hierarchy.AddEqualities(1, 1);
    first.B(0, j) = 1;
    first.b << -1;
    EqualityBlock second = hierarchy.AddEqualities(2, 1);
    second.B(0, 1 - j) = 1;
    second.b << -5;
    Solution solution(2, capacity);
    ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal) << j;
    // g = -6 on y_(1-j): the multiplier of the sum cancels it, with -6 on y_j.
    const std::vector<LevelMultipliers>& of = solution.levels[2].multipliers;
    EXPECT_NEAR(of[0].equality[0], 6, kTolerance) << j;
    EXPECT_NEAR(of[1].equality[0], -6, kTolerance) << j;
    for (const LevelMultipliers& none : solution.levels[3].multipliers) {
      EXPECT_EQ(none.equality, Eigen::VectorXd::Zero(none.equality.size()));
    }
  }
}

// y0 is in rows with coefficients of up to 8e6 that conflict and nearly depend
// on each other. So the coefficients of some rows in a stationarity equation
// are rounding. Division by such a coefficient would add 1e31 times the
// equation, and any y would be certified.
TEST(MultiplierWriter, DoesNotDivideByRounding) {
  const std::vector<LevelCapacity> capacity{{2, 2}, {0, 1}, {1, 0}};
  Hierarchy hierarchy(4, capacity);
  EqualityBlock sums = hierarchy.AddEqualities(0, 2);
  sums.B << -8388608, 1, 4, 8, 0, 0, 0, 1;
  sums.b << 0, -3;
  InequalityBlock bounds = hierarchy.AddInequalities(0, 2);
  bounds.C << -4194304, 0, 1, 0, -8388608, 0.00390625, 0, 0;
  bounds.lower << 0, 1;
  InequalityBlock none = hierarchy.AddInequalities(1, 1);
  none.C << 0, 0, 0, 1;
  none.upper << 0;
  hierarchy.AddEqualities(2, 1).B << 0, 0, 1, 0;
  Solver solver(4, capacity);
  Solution solution(4, capacity);
  (void)solver.Solve(hierarchy, &solution);
  for (const LevelSolution& level : solution.levels) {
    for (const LevelMultipliers& of : level.multipliers) {
      for (const double mu : of.equality) EXPECT_LT(std::abs(mu), 1e12);
      for (const double mu : of.inequality) EXPECT_LT(std::abs(mu), 1e12);
    }
  }
}

// Level 0: y0 + y1 = 4 and 2 (y1 + y2) <= 6. Level 1: 2 y0 = -2, and 4 y2 = 8
// with weight 3. Level 2: 5 y1 = 10.
class MultiplierWriterByHandTest : public testing::Test {
 protected:
  MultiplierWriterByHandTest() {
    EqualityBlock sum = hierarchy_.AddEqualities(0, 1);
    sum.B << 1, 1, 0;
    sum.b << -4;
    InequalityBlock bound = hierarchy_.AddInequalities(0, 1);
    bound.C << 0, 2, 2;
    bound.upper << 6;
    EqualityBlock targets = hierarchy_.AddEqualities(1, 2);
    targets.B << 2, 0, 0, 0, 0, 4;
    targets.b << 2, -8;
    targets.weight << 1, 3;
    EqualityBlock last = hierarchy_.AddEqualities(2, 1);
    last.B << 0, 5, 0;
    last.b << -10;
  }

  const std::vector<LevelCapacity> capacity_{{1, 1}, {2, 0}, {1, 0}};
  Hierarchy hierarchy_{3, capacity_};
};

// With the bound active, y = (t, 4 - t, t - 1). (2 t + 2)^2 + 3 (4 t - 12)^2 is
// least at t = 35 / 13.
TEST_F(MultiplierWriterByHandTest, GivesTheMultipliersOfEachLevel) {
  const Solution solution = Solve(hierarchy_, capacity_);
  EXPECT_LE((solution.y - Eigen::Vector3d(35, 17, 22) / 13).norm(), kTolerance);
  EXPECT_EQ(solution.levels[0].active[0], Side::kUpper);
  EXPECT_EQ(solution.levels[0].nullity, 2);  // The bound is not violated.
  EXPECT_EQ(solution.levels[1].nullity, 0);
  EXPECT_EQ(solution.levels[2].nullity, 0);
  // g = (192, 0, -192) / 13 + lambda (1, 1, 0) + mu (0, 2, 2) = 0.
  const LevelMultipliers& of_wishes = solution.levels[1].multipliers[0];
  EXPECT_NEAR(of_wishes.equality[0], -192. / 13, kTolerance);
  EXPECT_NEAR(of_wishes.inequality[0], 96. / 13, kTolerance);
  EXPECT_LE(Certifier(3, capacity_).Certify(hierarchy_, solution).worst(),
            kTolerance);
}

}  // namespace
}  // namespace poise
