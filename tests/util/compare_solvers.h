// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// Where the fast solver, the cascade and the certificate disagree about a
/// hierarchy, in words; empty if they do not. Statuses and nullities are to be
/// the same; certificates within the tolerance, and by multipliers that weigh at
/// most 1e10 (LargestMultiplier()); costs, residuals and slacks within it of what the level is added up from; and y within it, or 100 eps
/// times the condition of the active rows if that is more, of y's norm.
///
/// `living`, if given, is a solver that has solved others: it is the fast solver
/// then, and a new one is to agree with it as well.
std::string Disagreement(const HierarchyCase& drawn, double tolerance = 1e-9,
                         Solver* living = nullptr);

/// The same of the last of some ticks, after one solver has solved those before
/// it in their order: with one only, of a new solver alone.
std::string DisagreementAfter(const std::vector<HierarchyCase>& ticks,
                              double tolerance = 1e-9);

/// The most that a multiplier weighs, |multiplier| |row|, as a multiple of what
/// its level's own rows do: the sum of weight |residual| |row| and |slack| |row|,
/// and 1e-9 of the same with what these are added up from, so that multipliers
/// that are but rounding count for nothing. A certificate is relative to the sum
/// of both: where this is 1e20, any answer has one.
double LargestMultiplier(const Hierarchy& hierarchy, const Solution& solution);

/// Whether y is the shortest of all optima: its certificate as an answer to the
/// same hierarchy with one level more, y = 0. Multipliers of that level are
/// found by solving it so; whether they are right, the certificate says.
Certificate CertifyShortest(const HierarchyCase& drawn,
                            const Solution& solution);

}  // namespace poise
