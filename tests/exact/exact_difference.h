// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// Describes where Solver and Cascade differ from SolveExactly(). Returns "" if
/// they do not: the statuses are kOptimal, the nullities are equal, and y and
/// the cost of each level are within the rounding of a backward stable method.
/// That is
///     t = 8 (n + rows) eps condition^2,
/// relative to s = |y| plus the largest |b| / |row| or |bound| / |row|, and for
/// costs relative to sum weight (|row| s + |b or bounds|)^2. The condition is
/// the largest of the active rows up to any level, times the roots of weights.
/// It enters squared, because rows that contradict each other have residuals.
///
/// Source: Higham, "Accuracy and stability of numerical algorithms", 2nd ed.,
/// theorem 20.1.
std::string DifferenceFromExact(const HierarchyCase& drawn);

}  // namespace poise
