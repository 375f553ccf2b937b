// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/conflict.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"

namespace poise {
namespace {

// Violations below this, relative to the norm of the row, are rounding.
constexpr double kRounding = 1e-10;

double Norm(const Hierarchy& hierarchy, const HierarchyRow& row) {
  return row.equality ? hierarchy.B(row.level).row(row.row).norm()
                      : hierarchy.C(row.level).row(row.row).norm();
}

// Least-squares problem with all given rows in one level.
class Feasibility {
 public:
  Feasibility(const Hierarchy& hierarchy, int num_rows)
      : hierarchy_(hierarchy),
        one_level_(hierarchy.num_variables(), {{num_rows, num_rows}}),
        solver_(hierarchy.num_variables(), {{num_rows, num_rows}}),
        solution_(hierarchy.num_variables(), {{num_rows, num_rows}}) {}

  // Returns the violation of each row, over its norm, at the least-squares
  // optimum of all rows.
  Eigen::VectorXd Violations(const std::vector<HierarchyRow>& rows) {
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
    Eigen::VectorXd violations(rows.size());
    e = i = 0;
    for (size_t k = 0; k < rows.size(); ++k) {
      const LevelSolution& level = solution_.levels[0];
      violations[static_cast<Eigen::Index>(k)] =
          rows[k].equality ? std::abs(level.equality_residual[e++])
                           : level.slack[i++];
    }
    return violations;
  }

  // Sets the violated side of each row; pre: `rows` are those of the last call
  // of Violations().
  void TellSides(std::vector<HierarchyRow>* rows) const {
    Eigen::Index i = 0;
    for (HierarchyRow& row : *rows) {
      if (!row.equality) row.side = solution_.levels[0].active[i++];
    }
  }

  // Returns the rows among these that contradict each other, or nullopt if all
  // can be met. At the optimum, the sum of the violated rows, each times its
  // violation, is zero. So they contradict each other without the other rows.
  std::optional<std::vector<HierarchyRow>> Contradicting(
      const std::vector<HierarchyRow>& rows, double tolerance) {
    if (rows.empty()) return std::nullopt;
    const Eigen::VectorXd violations = Violations(rows);
    if (violations.maxCoeff() <= tolerance) return std::nullopt;
    std::vector<HierarchyRow> violated;
    for (size_t i = 0; i < rows.size(); ++i) {
      if (violations[static_cast<Eigen::Index>(i)] > kRounding) {
        violated.push_back(rows[i]);
      }
    }
    if (violated.size() < rows.size() &&
        Violations(violated).maxCoeff() <= tolerance) {
      return rows;
    }
    return violated;
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
  std::optional<std::vector<HierarchyRow>> fewer =
      feasibility.Contradicting(rows, tolerance);
  if (!fewer) return {};
  rows = *fewer;
  for (size_t i = 0; i < rows.size();) {
    std::vector<HierarchyRow> rest = rows;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    fewer = feasibility.Contradicting(rest, tolerance);
    if (fewer) {
      rows = *fewer;  // Still contains all rows before i: each is needed.
    } else {
      ++i;
    }
  }
  (void)feasibility.Violations(rows);
  feasibility.TellSides(&rows);
  return rows;
}

}  // namespace poise
