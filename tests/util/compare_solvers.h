// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "tests/util/random_hierarchy.h"

namespace poise {

/// Where the fast solver, the cascade and the certificate disagree about a
/// hierarchy, in words; empty if they do not. Statuses and nullities are to be
/// the same; certificates within the tolerance; costs, residuals and slacks
/// within it of what the level is added up from; and y within it, or 100 eps
/// times the condition of the active rows if that is more, of y's norm.
std::string Disagreement(const HierarchyCase& drawn, double tolerance = 1e-9);

}  // namespace poise
