// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <utility>

#include "poise/hqp/solution.h"
#include "poise/python/python_hierarchy.h"

namespace poise {

/// A solution with the problem that it belongs to.
struct PythonSolution {
  /// @param problem  its levels are shared, not copied.
  explicit PythonSolution(PythonHierarchy problem)
      : source(std::move(problem)),
        solution(source.num_variables, SizesOf(source)) {}

  int num_levels() const { return static_cast<int>(source.levels.size()); }
  int num_equalities(int level) const {
    return static_cast<int>(source.levels[level]->B.rows());
  }
  int num_inequalities(int level) const {
    return static_cast<int>(source.levels[level]->C.rows());
  }

  PythonHierarchy source;
  Solution solution;
  double microseconds = 0;
  double modelled_seconds = 0;
};

/// Returns a row for people: "level 0 'limits', row 2 'x'". C rows are the
/// inequalities.
std::string NameRow(const PythonHierarchy& source, int level, int row,
                    bool is_equality);

/// Returns a text that says, level by level, which rows are violated and which
/// active rows of the levels above keep the cost up, with their multipliers.
std::string ExplainSolution(const PythonSolution& solved);

}  // namespace poise
