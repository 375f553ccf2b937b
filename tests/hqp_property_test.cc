// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Properties of any hierarchy. Two independent solvers and the certificate
// agree. Lower levels do not change the optimum of the levels above, nor does a
// rotation of the variables change any cost.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/compare_solvers.h"
#include "poise/tests/util/random_hierarchy.h"
#include "poise/tests/util/ridders.h"

namespace poise {
namespace {

constexpr double kCertified = 1e-9;  // Largest allowed.

// Draws a random hierarchy, which shrinks to few variables, levels and rows.
HierarchyCase DrawHierarchy(bool with_inequalities = true, int weighted = 0) {
  RandomHierarchyOptions options;
  options.max_variables = *rc::gen::inRange(1, 13);
  options.max_levels = *rc::gen::inRange(1, 6);
  options.max_equalities = *rc::gen::inRange(1, 7);
  options.max_inequalities = with_inequalities ? *rc::gen::inRange(1, 9) : 0;
  options.degenerate = *rc::gen::inRange(0, 41);
  options.planted = *rc::gen::inRange(0, 61);
  options.selecting = *rc::gen::inRange(0, 101);
  options.scaled = 0;
  options.degenerate_vertex = *rc::gen::inRange(0, 31);
  options.integer = *rc::gen::inRange(0, 31);
  options.weighted = weighted;
  options.bounds = *rc::gen::inRange(0, 101);
  return MakeRandomHierarchy(*rc::gen::inRange(0, 1 << 30), options);
}

Solution Solve(const HierarchyCase& drawn) {
  const int n = drawn.hierarchy.num_variables();
  Solution solution(n, drawn.capacity);
  RC_ASSERT(Solver(n, drawn.capacity).Solve(drawn.hierarchy, &solution) ==
            Status::kOptimal);
  return solution;
}

void ExpectSameCosts(const HierarchyCase& drawn, const Solution& solution,
                     const Solution& reference, int num_levels) {
  for (int level = 0; level < num_levels; ++level) {
    RC_ASSERT(
        std::abs(solution.levels[level].cost - reference.levels[level].cost) <=
        kCertified * CostSize(drawn.hierarchy, level, reference));
    RC_ASSERT(solution.levels[level].nullity ==
              reference.levels[level].nullity);
  }
}

// Returns the first num_levels levels of a hierarchy in variables z, with
//     y = Q z.
// `by` is added to b of the level `moved`.
HierarchyCase Transform(const HierarchyCase& drawn, const Eigen::MatrixXd& Q,
                        int num_levels, int moved = -1, double by = 0) {
  const Hierarchy& from = drawn.hierarchy;
  std::vector<LevelCapacity> capacity(drawn.capacity.begin(),
                                      drawn.capacity.begin() + num_levels);
  HierarchyCase result{capacity, Hierarchy(from.num_variables(), capacity)};
  for (int k = 0; k < num_levels; ++k) {
    EqualityBlock e = result.hierarchy.AddEqualities(k, from.num_equalities(k));
    e.B = from.B(k) * Q;
    e.b = from.b(k);
    if (k == moved) e.b.array() += by;
    e.weight = from.weight(k);
    InequalityBlock i =
        result.hierarchy.AddInequalities(k, from.num_inequalities(k));
    i.C = from.C(k) * Q;
    i.lower = from.lower(k);
    i.upper = from.upper(k);
  }
  return result;
}

RC_GTEST_PROP(AnyHierarchy, IsSolvedAlikeByTwoSolversAndCertified, ()) {
  const HierarchyCase drawn = DrawHierarchy(true, *rc::gen::inRange(0, 61));
  const int n = drawn.hierarchy.num_variables();
  Solution reference(n, drawn.capacity);
  RC_ASSERT(Cascade(n, drawn.capacity).Solve(drawn.hierarchy, &reference) ==
            Status::kOptimal);
  const Solution solution = Solve(drawn);
  Certifier certifier(n, drawn.capacity);
  RC_ASSERT(certifier.Certify(drawn.hierarchy, reference).worst() <=
            kCertified);
  RC_ASSERT(certifier.Certify(drawn.hierarchy, solution).worst() <= kCertified);
  ExpectSameCosts(drawn, solution, reference, drawn.hierarchy.num_levels());
}

// One solver solves several ticks. Each solution is certified, agrees with the
// cascade and has minimum norm, as a new solver's does.
RC_GTEST_PROP(AnyHierarchy, IsSolvedByOneSolverWhileItChanges, ()) {
  HierarchyCase drawn = WithRoomToChange(DrawHierarchy());
  Solver living(drawn.hierarchy.num_variables(), drawn.capacity);
  for (int tick = 0; tick < 6; ++tick) {
    if (tick > 0) ChangeHierarchy(*rc::gen::inRange(0, 1 << 30), &drawn);
    RC_ASSERT(Disagreement(drawn, kCertified, &living) == "");
  }
}

RC_GTEST_PROP(AnyHierarchy, HasTheSameUpperCostsWithoutLowerLevels, ()) {
  const HierarchyCase drawn = DrawHierarchy();
  const int n = drawn.hierarchy.num_variables();
  const int num_levels = *rc::gen::inRange(1, drawn.hierarchy.num_levels() + 1);
  const HierarchyCase upper =
      Transform(drawn, Eigen::MatrixXd::Identity(n, n), num_levels);
  ExpectSameCosts(upper, Solve(upper), Solve(drawn), num_levels);
}

RC_GTEST_PROP(AnyHierarchy, HasTheSameCostsInRotatedVariables, ()) {
  const HierarchyCase drawn = DrawHierarchy();
  const int n = drawn.hierarchy.num_variables();
  Eigen::MatrixXd A(n, n);
  for (double& entry : A.reshaped()) {
    entry = *rc::gen::inRange(-100, 101) / 100.0;
  }
  const Eigen::MatrixXd Q = A.householderQr().householderQ();
  const int num_levels = drawn.hierarchy.num_levels();
  ExpectSameCosts(drawn, Solve(Transform(drawn, Q, num_levels)), Solve(drawn),
                  num_levels);
}

// Returns the rows that constrain y for a level: the equalities of the levels
// above it and their active inequalities.
Eigen::MatrixXd RowsAbove(const Hierarchy& hierarchy, const Solution& solution,
                          int level) {
  std::vector<Eigen::VectorXd> rows;
  for (int k = 0; k < level; ++k) {
    for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
      rows.push_back(hierarchy.B(k).row(i));
    }
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      if (solution.levels[k].active[i] == Side::kNone) continue;
      rows.push_back(hierarchy.C(k).row(i));
    }
  }
  Eigen::MatrixXd above(rows.size(), hierarchy.num_variables());
  for (int i = 0; i < above.rows(); ++i) above.row(i) = rows[i];
  return above;
}

// Returns twice the cost of a level at y. Of the inequalities, only those that
// `solution` violates count.
double SumOfSquares(const Hierarchy& hierarchy, const Solution& solution,
                    int level, const Eigen::VectorXd& y) {
  const Eigen::VectorXd w = hierarchy.B(level) * y + hierarchy.b(level);
  double sum = w.dot(hierarchy.weight(level).cwiseProduct(w));
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    const Side side = solution.levels[level].active[i];
    if (side == Side::kNone || solution.levels[level].slack[i] == 0) continue;
    const bool upper = side == Side::kUpper;
    const double bound =
        (upper ? hierarchy.upper(level) : hierarchy.lower(level))[i];
    sum += std::pow(hierarchy.C(level).row(i).dot(y) - bound, 2);
  }
  return sum;
}

bool HasSameSides(const Hierarchy& hierarchy, const Solution& a,
                  const Solution& b) {
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      if (a.levels[k].active[i] != b.levels[k].active[i]) return false;
    }
  }
  return true;
}

// Checks the nullspace projection by numerical derivatives with Ceres. A change
// of a level's targets must not change the residuals of the levels above. Along
// the nullspace of the rows above, the level's cost must have zero gradient.
RC_GTEST_PROP(AnyHierarchy, OptimisesEachLevelInTheNullspaceOfTheLevelsAbove,
              ()) {
  const HierarchyCase drawn = DrawHierarchy(*rc::gen::element(false, true));
  const Hierarchy& hierarchy = drawn.hierarchy;
  const int n = hierarchy.num_variables();
  const int level = *rc::gen::inRange(0, hierarchy.num_levels());
  const auto solve = [&](double by) -> Solution {
    const HierarchyCase moved =
        Transform(drawn, Eigen::MatrixXd::Identity(n, n),
                  hierarchy.num_levels(), level, by);
    Solution solution(n, moved.capacity);
    RC_ASSERT(Cascade(n, moved.capacity).Solve(moved.hierarchy, &solution) ==
              Status::kOptimal);
    return solution;
  };
  const Solution solution = solve(0);
  const Eigen::VectorXd y = solution.y;
  const Eigen::MatrixXd above = RowsAbove(hierarchy, solution, level);
  // While the active rows stay the same, y is a linear function of the targets.
  if (HasSameSides(hierarchy, solution, solve(kRiddersReach)) &&
      HasSameSides(hierarchy, solution, solve(-kRiddersReach))) {
    const Eigen::VectorXd rate =
        RiddersRate([&](double by) -> Eigen::VectorXd { return solve(by).y; });
    const double scale = 1 + above.norm() * (y.norm() + rate.norm());
    RC_ASSERT((above * rate).norm() <= kRiddersPrecision * scale);
  }

  const Eigen::MatrixXd N = above.rows() == 0
                                ? Eigen::MatrixXd::Identity(n, n)
                                : Eigen::MatrixXd(above.fullPivLu().kernel());
  const auto cost = [&](const Eigen::VectorXd& z) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(
        1, SumOfSquares(hierarchy, solution, level, y + N * z) / 2);
  };
  const Eigen::MatrixXd gradient =
      RiddersJacobian(cost, Eigen::VectorXd::Zero(N.cols()));
  // The scale of the gradient: each row contributes |row N| (|row y| +
  // |target|). An inequality contributes both its value and its bound, which is
  // the value less a slack; hence 2 C.
  const auto B = hierarchy.B(level), C = hierarchy.C(level);
  const double size =
      (1 + (B * N).norm() + (C * N).norm()) *
      (1 + hierarchy.b(level).norm() + (B.norm() + 2 * C.norm()) * y.norm() +
       solution.levels[level].slack.head(C.rows()).norm());
  RC_ASSERT(gradient.norm() <=
            kRiddersPrecision * size * (1 + hierarchy.weight(level).sum()));
}

}  // namespace
}  // namespace poise
