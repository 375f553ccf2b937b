// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <vector>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// A hierarchy that fails, made as small as it still does: without the levels,
/// rows, variables and bounds that do not matter, with weights 1 and whole
/// numbers where these do. Nothing of what is left can be left out alone.
HierarchyCase ShrinkHierarchy(
    const HierarchyCase& failing,
    const std::function<bool(const HierarchyCase&)>& fails);

/// The same of ticks that one solver solves in their order, of which the last one
/// fails: first without the ticks before it that do not matter, then what does
/// not matter of each that is left. All keep the same variables.
std::vector<HierarchyCase> ShrinkTicks(
    const std::vector<HierarchyCase>& failing,
    const std::function<bool(const std::vector<HierarchyCase>&)>& fails);

}  // namespace poise
