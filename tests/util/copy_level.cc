// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/copy_level.h"

namespace poise {

LevelBlocks CopyLevel(const Hierarchy& from, int level, Hierarchy* to) {
  EqualityBlock equalities =
      to->AddEqualities(level, from.num_equalities(level));
  equalities.B = from.B(level);
  equalities.b = from.b(level);
  equalities.weight = from.weight(level);
  InequalityBlock inequalities =
      to->AddInequalities(level, from.num_inequalities(level));
  inequalities.C = from.C(level);
  inequalities.lower = from.lower(level);
  inequalities.upper = from.upper(level);
  return {equalities, inequalities};
}

}  // namespace poise
