// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/python_hierarchy.h"

namespace poise {

std::vector<LevelCapacity> SizesOf(const PythonHierarchy& hierarchy) {
  std::vector<LevelCapacity> sizes;
  for (const PythonLevel& level : hierarchy.levels) {
    sizes.push_back(
        {static_cast<int>(level.B.rows()), static_cast<int>(level.C.rows())});
  }
  return sizes;
}

Hierarchy MakeHierarchy(const PythonHierarchy& hierarchy) {
  Hierarchy made(hierarchy.num_variables, SizesOf(hierarchy));
  for (int i = 0; i < static_cast<int>(hierarchy.levels.size()); ++i) {
    const PythonLevel& level = hierarchy.levels[i];
    EqualityBlock equalities =
        made.AddEqualities(i, static_cast<int>(level.B.rows()));
    equalities.B = level.B;
    equalities.b = level.b;
    equalities.weight = level.weight;
    InequalityBlock inequalities =
        made.AddInequalities(i, static_cast<int>(level.C.rows()));
    inequalities.C = level.C;
    inequalities.lower = level.lower;
    inequalities.upper = level.upper;
  }
  made.FindSpans();
  return made;
}

}  // namespace poise
