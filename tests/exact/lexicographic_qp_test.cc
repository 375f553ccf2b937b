// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The expected answers were derived by hand. Comparisons are exact.
#include "poise/tests/exact/lexicographic_qp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/tests/exact/check_optimal.h"
#include "poise/tests/util/hierarchy_by_hand.h"

namespace poise {
namespace {

using Rows = std::vector<RowByHand>;

// Expects y and the costs of the levels; minimum norm is checked by y.
void ExpectOptimum(const Hierarchy& hierarchy, const RationalVector& y,
                   const RationalVector& costs) {
  const ExactOptimum optimum = SolveExactly(hierarchy);
  EXPECT_EQ(optimum.y, y);
  ASSERT_EQ(optimum.levels.size(), costs.size() + 1);
  for (size_t k = 0; k < costs.size(); ++k) {
    EXPECT_EQ(optimum.levels[k].cost, costs[k]) << "level " << k;
  }
}

void ExpectOptimum(int num_variables, const Rows& rows, const RationalVector& y,
                   const RationalVector& costs) {
  ExpectOptimum(HierarchyByHand(num_variables, rows).hierarchy, y, costs);
}

Rational Half(int numerator) { return Rational(numerator, 2); }

TEST(LexicographicQp, SolvesEqualitiesByHand) {
  // y = (1 + 3) / (1 + 9).
  ExpectOptimum(1, {{0, {1}, 1, 1}, {0, {3}, 1, 1}}, {Rational(2, 5)},
                {Rational(1, 5)});
  // Minimum norm on a line.
  ExpectOptimum(2, {{0, {1, 2}, 5, 5}}, {1, 2}, {0});
  // Level 1 moves along the line y0 + y1 = 1 to the foot of the point (3, 0).
  ExpectOptimum(2, {{0, {1, 1}, 1, 1}, {1, {1, 0}, 3, 3}, {1, {0, 1}, 0, 0}},
                {2, -1}, {0, 1});
}

TEST(LexicographicQp, ProjectsOntoInequalitiesByHand) {
  // The example of docs/hqp.md.
  ExpectOptimum(
      2, {{0, {1, 0}, -INFINITY, 1}, {1, {1, 0}, 3, 3}, {1, {0, 1}, 2, 2}},
      {1, 2}, {0, 2});
  const Rows wedge = {{0, {3, 1}, -INFINITY, 1}, {0, {1, 3}, -INFINITY, 1}};
  Rows corner = wedge, side = wedge;
  corner.insert(corner.end(), {{1, {1, 0}, 1, 1}, {1, {0, 1}, 1, 1}});
  ExpectOptimum(2, corner, {Rational(1, 4), Rational(1, 4)},
                {0, Rational(9, 16)});
  // (2, 0) - (3, 1) / 2: the first row is active with the multiplier 1/2.
  side.insert(side.end(), {{1, {1, 0}, 2, 2}, {1, {0, 1}, 0, 0}});
  ExpectOptimum(2, side, {Half(1), Half(-1)}, {0, Rational(5, 4)});
  const ExactOptimum optimum = SolveExactly(HierarchyByHand(2, side).hierarchy);
  EXPECT_EQ(optimum.levels[1].multipliers[0].inequality,
            RationalVector({Half(1), 0}));
}

TEST(LexicographicQp, GivesALowerBoundANegativeMultiplier) {
  const ExactOptimum optimum = SolveExactly(
      HierarchyByHand(1, {{0, {2}, 4, INFINITY}, {1, {1}, -1, -1}}).hierarchy);
  EXPECT_EQ(optimum.y, RationalVector({2}));
  EXPECT_EQ(optimum.levels[1].multipliers[0].inequality,
            RationalVector({Half(-3)}));
}

TEST(LexicographicQp, SharesContradictoryRows) {
  // y <= 0 and y >= 1: half each. Level 1 cannot move y any more.
  ExpectOptimum(1,
                {{0, {1}, -INFINITY, 0}, {0, {1}, 1, INFINITY}, {1, {1}, 5, 5}},
                {Half(1)}, {Rational(1, 4), Rational(81, 8)});
  // A row of zeros that cannot be met has a slack and no effect.
  ExpectOptimum(1, {{0, {0}, 2, 3}, {1, {1}, 7, 7}}, {7}, {2, 0});
  // Level 1 contradicts level 0.
  ExpectOptimum(2, {{0, {1, 1}, 1, 1}, {1, {2, 2}, 3, 3}, {2, {1, 0}, 0, 0}},
                {0, 1}, {0, Half(1), 0});
}

TEST(LexicographicQp, KeepsAViolatedRowConstant) {
  // Level 1 violates y0 >= 1 by 1 and y1 >= 1 not at all. Level 2 would move
  // both down.
  ExpectOptimum(2,
                {{0, {1, 0}, -INFINITY, 0},
                 {1, {1, 0}, 1, INFINITY},
                 {1, {0, 1}, 1, INFINITY},
                 {2, {1, 0}, -4, -4},
                 {2, {0, 1}, -4, -4}},
                {0, 1}, {0, Half(1), Half(16 + 25)});
}

TEST(LexicographicQp, SolvesDegenerateVertices) {
  // Four rows of a cone and two multiples of them meet in y = 0.
  const Rows cone = {
      {0, {-1, 3, 0}, -INFINITY, 0}, {0, {-1, -3, 0}, -INFINITY, 0},
      {0, {-1, 0, 3}, -INFINITY, 0}, {0, {-1, 0, -3}, -INFINITY, 0},
      {0, {-2, 6, 0}, -INFINITY, 0}, {0, {2, 6, 0}, 0, INFINITY}};
  Rows corner = cone, edge = cone;
  corner.insert(
      corner.end(),
      {{1, {1, 0, 0}, -9, -9}, {1, {0, 1, 0}, 1, 1}, {1, {0, 0, 1}, -2, -2}});
  ExpectOptimum(3, corner, {0, 0, 0}, {0, 43});
  // From the vertex along the edge y0 = 3 y1 = -3 y2: minimise
  // (3 t - 1)^2 + (t - 8)^2 + (t - 8)^2, so t = 19 / 11.
  edge.insert(
      edge.end(),
      {{1, {1, 0, 0}, 1, 1}, {1, {0, 1, 0}, 8, 8}, {1, {0, 0, 1}, -8, -8}});
  const Rational t(19, 11);
  ExpectOptimum(3, edge, {3 * t, t, -t},
                {0, ((3 * t - 1) * (3 * t - 1) + 2 * (t - 8) * (t - 8)) / 2});
}

TEST(LexicographicQp, TreatsEqualBoundsAsAnEquality) {
  for (const double target : {-3., 5.}) {
    Hierarchy hierarchy(1, {{0, 1}, {1, 0}});
    hierarchy.Clear(2);
    InequalityBlock bound = hierarchy.AddInequalities(0, 1);
    bound.C << 2;
    bound.lower << 1;
    bound.upper << 1;
    EqualityBlock desired = hierarchy.AddEqualities(1, 1);
    desired.B << 1;
    desired.b << -target;
    const Rational error = Half(1) - Rational(target);
    ExpectOptimum(hierarchy, {Half(1)}, {0, error * error / 2});
  }
}

TEST(LexicographicQp, IgnoresInfiniteBoundsAndZeroWeights) {
  Hierarchy hierarchy(2, {{2, 1}, {1, 0}});
  hierarchy.Clear(2);
  EqualityBlock rows = hierarchy.AddEqualities(0, 2);
  rows.B << 1, 0, 1, 1;
  rows.b << -5, -1;
  rows.weight << 0, 2;
  hierarchy.AddInequalities(0, 1).C << 1, 0;
  EqualityBlock last = hierarchy.AddEqualities(1, 1);
  last.B << 1, -1;
  ExpectOptimum(hierarchy, {Half(1), Half(1)}, {0, 0});
  EXPECT_EQ(SolveExactly(hierarchy).levels[0].nullity, 1);
}

TEST(LexicographicQp, WeighsRowsByHand) {
  Hierarchy hierarchy(1, {{2, 0}});
  hierarchy.Clear(1);
  EqualityBlock rows = hierarchy.AddEqualities(0, 2);
  rows.B << 1, 1;
  rows.b << 0, -3;
  rows.weight << 1, 2;
  ExpectOptimum(hierarchy, {2}, {3});
}

TEST(LexicographicQp, AcceptsLevelsWithoutRows) {
  Hierarchy hierarchy(2, {{0, 0}, {1, 0}});
  hierarchy.Clear(0);
  ExpectOptimum(hierarchy, {0, 0}, {});
  hierarchy.Clear(2);
  EqualityBlock row = hierarchy.AddEqualities(1, 1);
  row.B << 0, 4;
  row.b << -1;
  ExpectOptimum(hierarchy, {0, Rational(1, 4)}, {0, 0});
}

TEST(LexicographicQp, ConvertsDoublesExactly) {
  // The double 0.1 is not 1/10.
  ExpectOptimum(1, {{0, {1}, 0.1, 0.1}}, {Rational(0.1)}, {0});
  EXPECT_NE(Rational(0.1), Rational(1, 10));
}

TEST(LexicographicQp, ThrowsOnInvalidInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SolveExactly(HierarchyByHand(1, {{0, {nan}, 0, 1}}).hierarchy),
               std::invalid_argument);
  EXPECT_THROW(SolveExactly(HierarchyByHand(1, {{0, {1}, 1, 0}}).hierarchy),
               std::invalid_argument);
}

TEST(CheckOptimal, ThrowsIfOneNumberIsWrong) {
  const HierarchyByHand problem(2, {{0, {1, 1}, -INFINITY, 0},
                                    {0, {1, 0}, -7, 7},
                                    {1, {1, 0}, 3, 3},
                                    {1, {0, 1}, 2, 2}});
  const ExactOptimum right = SolveExactly(problem.hierarchy);
  EXPECT_NO_THROW(CheckOptimal(problem.hierarchy, right));
  const auto throws = [&problem](const ExactOptimum& wrong) {
    EXPECT_THROW(CheckOptimal(problem.hierarchy, wrong), std::logic_error);
  };
  // One part in 1e30, which no double would show.
  const Rational little(1, mpz_class("1000000000000000000000000000000"));
  ExactOptimum wrong = right;
  wrong.y[0] += little;
  throws(wrong);
  wrong = right;
  wrong.levels[1].cost += little;
  throws(wrong);
  wrong = right;
  wrong.levels[1].multipliers[0].inequality[0] += little;
  throws(wrong);
  // A multiplier on a row that is not active.
  wrong = right;
  wrong.levels[1].multipliers[0].inequality[1] += little;
  throws(wrong);
}

TEST(CheckOptimal, RequiresTheSignOfAMultiplier) {
  // y = 0 is at the bound y <= 0, but the target -1 is inside.
  const HierarchyByHand problem(1, {{0, {1}, -INFINITY, 0}, {1, {1}, -1, -1}});
  ExactOptimum wrong = SolveExactly(problem.hierarchy);
  wrong.y = {0};
  wrong.levels[1].cost = Half(1);
  wrong.levels[1].multipliers[0].inequality = {-1};
  EXPECT_THROW(CheckOptimal(problem.hierarchy, wrong), std::logic_error);
  // y = 0 is at the bound y >= 0, but the target 1 is inside.
  const HierarchyByHand mirrored(1, {{0, {1}, 0, INFINITY}, {1, {1}, 1, 1}});
  wrong.levels[1].multipliers[0].inequality = {1};
  EXPECT_THROW(CheckOptimal(mirrored.hierarchy, wrong), std::logic_error);
}

TEST(CheckOptimal, RequiresThatZeroWeightsHaveNoMultiplier) {
  Hierarchy hierarchy(1, {{1, 0}, {1, 0}});
  hierarchy.Clear(2);
  EqualityBlock ignored = hierarchy.AddEqualities(0, 1);
  ignored.B << 1;
  ignored.weight << 0;
  EqualityBlock desired = hierarchy.AddEqualities(1, 1);
  desired.B << 1;
  desired.b << -1;
  ExactOptimum wrong = SolveExactly(hierarchy);
  EXPECT_EQ(wrong.y, RationalVector({1}));
  wrong.y = {0};
  wrong.levels[1].cost = Half(1);
  wrong.levels[1].multipliers[0].equality = {1};
  wrong.levels[2].cost = 0;
  wrong.levels[2].multipliers[1].equality = {0};
  EXPECT_THROW(CheckOptimal(hierarchy, wrong), std::logic_error);
}

}  // namespace
}  // namespace poise
