// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/conflict.h"

#include <algorithm>
#include <cmath>

#include "hqp/solution.h"
#include "hqp/solver.h"

namespace poise {
namespace {

double Norm(const Hierarchy& hierarchy, const HierarchyRow& row) {
  return row.equality ? hierarchy.B(row.level).row(row.row).norm()
                      : hierarchy.C(row.level).row(row.row).norm();
}

// Rows, all in one level: each violated as little as can be.
class Feasibility {
 public:
  Feasibility(const Hierarchy& hierarchy, int num_rows)
      : hierarchy_(hierarchy),
        one_level_(hierarchy.num_variables(), {{num_rows, num_rows}}),
        solver_(hierarchy.num_variables(), {{num_rows, num_rows}}),
        solution_(hierarchy.num_variables(), {{num_rows, num_rows}}) {}

  // The largest violation left, over its row's norm.
  double Violation(const std::vector<HierarchyRow>& rows) {
    one_level_.Clear(1);
    const int equalities = static_cast<int>(
        std::count_if(rows.begin(), rows.end(),
                      [](const HierarchyRow& row) { return row.equality; }));
    EqualityBlock equal = one_level_.AddEqualities(0, equalities);
    InequalityBlock unequal = one_level_.AddInequalities(
        0, static_cast<int>(rows.size()) - equalities);
    int e = 0, i = 0;
    for (const HierarchyRow& row : rows) {
      const double scale = 1 / Norm(hierarchy_, row);
      if (row.equality) {
        equal.B.row(e) = scale * hierarchy_.B(row.level).row(row.row);
        equal.b[e++] = scale * hierarchy_.b(row.level)[row.row];
      } else {
        unequal.C.row(i) = scale * hierarchy_.C(row.level).row(row.row);
        unequal.lower[i] = scale * hierarchy_.lower(row.level)[row.row];
        unequal.upper[i++] = scale * hierarchy_.upper(row.level)[row.row];
      }
    }
    solver_.Forget();
    (void)solver_.Solve(one_level_, &solution_);
    double worst = 0;
    if (e > 0) {
      worst = solution_.levels[0]
                  .equality_residual.head(e)
                  .lpNorm<Eigen::Infinity>();
    }
    if (i > 0) {
      worst = std::max(worst, solution_.levels[0].slack.head(i).maxCoeff());
    }
    return worst;
  }

 private:
  const Hierarchy& hierarchy_;
  Hierarchy one_level_;
  Solver solver_;
  Solution solution_;
};

}  // namespace

std::vector<HierarchyRow> FindConflict(const Hierarchy& hierarchy, int level,
                                       double tolerance) {
  std::vector<HierarchyRow> rows;
  for (int from = 0; from <= level; ++from) {
    for (int i = 0; i < hierarchy.num_equalities(from); ++i) {
      rows.push_back({from, i, true});
    }
    for (int i = 0; i < hierarchy.num_inequalities(from); ++i) {
      rows.push_back({from, i, false});
    }
  }
  rows.erase(std::remove_if(rows.begin(), rows.end(),
                            [&](const HierarchyRow& row) {
                              return Norm(hierarchy, row) == 0;
                            }),
             rows.end());
  if (rows.empty()) return {};
  Feasibility feasibility(hierarchy, static_cast<int>(rows.size()));
  if (feasibility.Violation(rows) <= tolerance) return {};
  for (size_t i = 0; i < rows.size();) {
    std::vector<HierarchyRow> rest = rows;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    if (!rest.empty() && feasibility.Violation(rest) > tolerance) {
      rows = rest;
    } else {
      ++i;
    }
  }
  return rows;
}

}  // namespace poise
