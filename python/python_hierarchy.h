// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// One level as Python gave it, see EqualityBlock and InequalityBlock.
struct PythonLevel {
  RowMajorMatrix B, C;
  Eigen::VectorXd b, weight, lower, upper;
  std::string name;
  std::vector<std::string> equality_names, inequality_names;
};

/// A hierarchy that grows level by level. The solver needs the sizes of all
/// levels before it allocates, so the rows are kept here until then.
struct PythonHierarchy {
  int num_variables = 0;
  /// A level never changes, so that Python objects and solutions share it.
  std::vector<std::shared_ptr<PythonLevel>> levels;
};

/// Returns the rows of each level.
std::vector<LevelCapacity> SizesOf(const PythonHierarchy& hierarchy);

/// Copies the rows into a hierarchy for the solver, in place of its rows.
/// pre: its capacity has room for them.
void CopyRows(const PythonHierarchy& hierarchy, Hierarchy* to);

/// Returns a new hierarchy for the solver. Copies the rows.
Hierarchy MakeHierarchy(const PythonHierarchy& hierarchy);

}  // namespace poise
