// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <vector>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// Shrinks a failing hierarchy while it still fails. Removes levels, rows,
/// variables and bounds that do not matter, and replaces numbers by integers
/// and weights by 1 where possible. Nothing that is left can be removed alone.
HierarchyCase ShrinkHierarchy(
    const HierarchyCase& failing,
    const std::function<bool(const HierarchyCase&)>& fails);

/// Shrinks a failing sequence of ticks, which one solver solves in order and
/// whose last tick fails. First removes earlier ticks that do not matter, then
/// shrinks each tick that is left. All ticks keep the same variables.
std::vector<HierarchyCase> ShrinkTicks(
    const std::vector<HierarchyCase>& failing,
    const std::function<bool(const std::vector<HierarchyCase>&)>& fails);

}  // namespace poise
