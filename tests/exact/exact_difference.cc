// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/exact_difference.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/math/rank.h"
#include "poise/tests/exact/lexicographic_qp.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

Eigen::VectorXd Rounded(const RationalVector& exact) {
  Eigen::VectorXd rounded(exact.size());
  for (size_t j = 0; j < exact.size(); ++j) rounded[j] = exact[j].get_d();
  return rounded;
}

// The rows that determine an optimum, times the root of their weight.
struct ActiveRows {
  Eigen::MatrixXd rows;
  // Largest distance of one of their hyperplanes from y = 0.
  double largest_distance;
  // Largest condition number of the rows up to any level. Further rows may
  // reduce the condition, but cannot move y any more.
  double worst_condition;
};

ActiveRows FindActiveRows(const Hierarchy& hierarchy,
                          const Solution& solution) {
  ActiveRows active{Eigen::MatrixXd(0, hierarchy.num_variables()), 0, 1};
  const auto add = [&active](const Eigen::RowVectorXd& row, double target,
                             double weight) {
    const double norm = row.norm();
    if (norm == 0) return;
    active.rows.conservativeResize(active.rows.rows() + 1, Eigen::NoChange);
    active.rows.bottomRows(1) = std::sqrt(weight) * row;
    active.largest_distance =
        std::max(active.largest_distance, std::abs(target) / norm);
  };
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
      const double weight = hierarchy.weight(k)[i];
      if (weight == 0) continue;
      add(hierarchy.B(k).row(i), hierarchy.b(k)[i], weight);
    }
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      const Side side = solution.levels[k].active[i];
      if (side == Side::kNone) continue;
      add(hierarchy.C(k).row(i),
          side == Side::kUpper ? hierarchy.upper(k)[i] : hierarchy.lower(k)[i],
          1);
    }
    if (active.rows.rows() == 0) continue;
    RankRevealing svd(static_cast<int>(active.rows.rows()),
                      hierarchy.num_variables());
    svd.Compute(active.rows);
    active.worst_condition = std::max(active.worst_condition, svd.condition());
  }
  return active;
}

// Returns the size of the terms that add up to the cost of a level, where y has
// rounding errors relative to this size.
double CostSize(const Hierarchy& hierarchy, int level, double size_of_y) {
  double size = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const double term = hierarchy.B(level).row(i).norm() * size_of_y +
                        std::abs(hierarchy.b(level)[i]);
    size += hierarchy.weight(level)[i] * term * term;
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    double term = hierarchy.C(level).row(i).norm() * size_of_y;
    for (const double bound :
         {hierarchy.lower(level)[i], hierarchy.upper(level)[i]}) {
      if (std::isfinite(bound)) term += std::abs(bound);
    }
    size += term * term;
  }
  return size;
}

void Compare(const std::string& name, const Hierarchy& hierarchy,
             const ExactOptimum& exact, Status status, const Solution& solution,
             std::ostream* text) {
  if (status != Status::kOptimal) {
    *text << name << " finds no optimum; ";
    return;
  }
  const ActiveRows active = FindActiveRows(hierarchy, solution);
  const int rows = static_cast<int>(active.rows.rows());
  const int n = hierarchy.num_variables();
  const double condition = active.worst_condition;
  const double relative = Rounding(1, n + rows, condition * condition);
  const Eigen::VectorXd y = Rounded(exact.y);
  const double size = y.norm() + active.largest_distance;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    const LevelSolution& level = solution.levels[k];
    const double cost = exact.levels[k].cost.get_d();
    if (!(std::abs(level.cost - cost) <=
          relative * CostSize(hierarchy, k, size))) {
      *text << name << "'s cost of level " << k << " is " << level.cost
            << ", not " << cost << "; ";
    }
    if (level.nullity != exact.levels[k].nullity) {
      *text << name << "'s nullity of level " << k << " is " << level.nullity
            << ", not " << exact.levels[k].nullity << "; ";
    }
  }
  if (!((solution.y - y).norm() <= relative * size)) {
    *text << name << "'s y is [" << solution.y.transpose() << "], not ["
          << y.transpose() << "]; ";
  }
}

}  // namespace

std::string DifferenceFromExact(const HierarchyCase& drawn) {
  const Hierarchy& hierarchy = drawn.hierarchy;
  const int n = hierarchy.num_variables();
  const ExactOptimum exact = SolveExactly(hierarchy);
  std::ostringstream text;
  Solution solution(n, drawn.capacity);
  Status status = Solver(n, drawn.capacity).Solve(hierarchy, &solution);
  Compare("Solver", hierarchy, exact, status, solution, &text);
  status = Cascade(n, drawn.capacity).Solve(hierarchy, &solution);
  Compare("Cascade", hierarchy, exact, status, solution, &text);
  return text.str();
}

}  // namespace poise
