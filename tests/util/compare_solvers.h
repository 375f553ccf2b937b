// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/random_hierarchy.h"

namespace poise {

/// Describes where the fast solver, the cascade and the certificate disagree
/// about a hierarchy. Returns "" if they agree, that is:
/// - Statuses and nullities are equal.
/// - Certificates are within the tolerance, with multipliers of at most 1e10,
///   see LargestMultiplier().
/// - Costs agree within the tolerance times CostSize(), residuals and slacks
///   within the tolerance times its square root.
/// - y has minimum norm, see CertifyShortest(). It agrees within the tolerance
///   times |y|. If larger, 100 eps times the condition number of the active
///   rows replaces the tolerance.
///
/// `living`, if given, is a warm solver: it has solved other hierarchies. It is
/// then compared in the same way, in addition to a new solver.
std::string Disagreement(const HierarchyCase& drawn, double tolerance = 1e-9,
                         Solver* living = nullptr);

/// Returns the Disagreement() about the last of some ticks. A warm solver has
/// solved the ticks before it, in their order. With one tick, only a new solver
/// is compared.
std::string DisagreementAfter(const std::vector<HierarchyCase>& ticks,
                              double tolerance = 1e-9);

/// Returns the largest |multiplier| |row| of all levels, as a multiple of its
/// level's gradient. The gradient is the sum of weight |residual| |row| and
/// |slack| |row| over the level's own rows. It also contains 1e-9 of the terms
/// from which residuals and slacks are computed, so that a multiplier that is
/// only a rounding error does not count. A certificate is relative to the sum
/// of multipliers and gradient: where this ratio is 1e20, any answer has a
/// small certificate.
double LargestMultiplier(const Hierarchy& hierarchy, const Solution& solution);

/// Certifies that y has minimum norm among all optima. Returns the certificate
/// of y as an answer to the same hierarchy with one more level, y = 0. The
/// multipliers of that level come from a solution of the longer hierarchy; the
/// certificate shows whether they are right.
Certificate CertifyShortest(const HierarchyCase& drawn,
                            const Solution& solution);

}  // namespace poise
