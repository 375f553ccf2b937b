// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/python_hierarchy.h"

namespace poise {

std::vector<LevelCapacity> SizesOf(const PythonHierarchy& hierarchy) {
  std::vector<LevelCapacity> sizes;
  for (const auto& level : hierarchy.levels) {
    sizes.push_back(
        {static_cast<int>(level->B.rows()), static_cast<int>(level->C.rows())});
  }
  return sizes;
}

void CopyRows(const PythonHierarchy& hierarchy, Hierarchy* to) {
  const int num_levels = static_cast<int>(hierarchy.levels.size());
  to->Clear(num_levels);
  for (int i = 0; i < num_levels; ++i) {
    const PythonLevel& level = *hierarchy.levels[i];
    EqualityBlock equalities =
        to->AddEqualities(i, static_cast<int>(level.B.rows()));
    equalities.B = level.B;
    equalities.b = level.b;
    equalities.weight = level.weight;
    InequalityBlock inequalities =
        to->AddInequalities(i, static_cast<int>(level.C.rows()));
    inequalities.C = level.C;
    inequalities.lower = level.lower;
    inequalities.upper = level.upper;
  }
  to->FindSpans();
}

Hierarchy MakeHierarchy(const PythonHierarchy& hierarchy) {
  Hierarchy made(hierarchy.num_variables, SizesOf(hierarchy));
  CopyRows(hierarchy, &made);
  return made;
}

}  // namespace poise
