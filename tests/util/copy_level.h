// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/hqp/hierarchy.h"

namespace poise {

/// The rows of a level.
struct LevelBlocks {
  EqualityBlock equalities;
  InequalityBlock inequalities;
};

/// Adds the rows of a level to the same level of another hierarchy with as many
/// variables. Returns the new rows, so that the caller can change them. Their
/// spans are all columns. pre: `to` has room for them.
LevelBlocks CopyLevel(const Hierarchy& from, int level, Hierarchy* to);

}  // namespace poise
