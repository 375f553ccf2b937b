// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/hqp/hierarchy.h"
#include "poise/tests/exact/exact_optimum.h"

namespace poise {

/// Solves a hierarchy in rational arithmetic, one level after the other, as
/// docs/hqp.md defines the problem. Shares no code with the solvers of hqp, and
/// checks its answer by CheckOptimal(). For small hierarchies: six variables
/// and four levels of four rows take about 10 ms.
///
/// On each level the optimum is unique in the residuals of nonzero weight and
/// in the slacks. So the lower levels keep these rows constant: the equalities,
/// and the violated inequalities. The inequalities that are met stay met.
/// Throws std::invalid_argument if CheckInput() finds an error.
ExactOptimum SolveExactly(const Hierarchy& hierarchy);

}  // namespace poise
