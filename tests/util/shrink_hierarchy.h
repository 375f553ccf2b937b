// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>

#include "tests/util/random_hierarchy.h"

namespace poise {

/// A hierarchy that fails, made as small as it still does: without the levels,
/// rows, variables and bounds that do not matter, with weights 1 and whole
/// numbers where these do. Nothing of what is left can be left out alone.
HierarchyCase ShrinkHierarchy(
    const HierarchyCase& failing,
    const std::function<bool(const HierarchyCase&)>& fails);

}  // namespace poise
