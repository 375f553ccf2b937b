// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/tests/exact/rational.h"

namespace poise {

/// A convex QP in a vector x: least squares with linear constraints.
///
///     minimise   1/2 sum weight (F x + f)^2
///     subject to E x = constant,  G x <= g
///
/// The constant is the value of E x at the start.
struct RationalQp {
  RationalMatrix F;
  RationalVector f, weight;
  RationalMatrix E;
  RationalMatrix G;
  RationalVector g;
};

/// An optimum and its multipliers: with the gradient d of the cost at x,
///     d + E' equality + G' inequality = 0,  inequality >= 0,
/// and the multiplier of an inequality that is not active is 0.
struct RationalQpOptimum {
  RationalVector x, equality, inequality;
};

/// Minimises the QP from a start with G x <= g. The method is an active-set
/// method without a working set: each step starts from the set of all active
/// constraints, so that a degenerate vertex needs no rule against cycling.
///
/// - While the cost can fall with all active constraints kept, the step leads
///   to the minimum on them, or to the first blocking constraint.
/// - Otherwise the step is the projection of the negative gradient onto the
///   cone of the directions that keep G x <= g. If it is zero, the projection
///   gives the multipliers, and x is optimal.
///
/// The method ends: a minimum on a set of active constraints has one cost, the
/// cost falls with each step after it, and there are finitely many sets.
RationalQpOptimum Minimise(const RationalQp& qp, RationalVector x);

}  // namespace poise
