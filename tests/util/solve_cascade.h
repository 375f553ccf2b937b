// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/hqp/reference/cascade.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// Solves a hierarchy with a new cascade. The test fails if the cascade finds
/// no optimum.
Solution SolveCascade(const HierarchyCase& drawn, RowSpaceMethod method);

}  // namespace poise
