// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/tests/exact/rational.h"

namespace poise {

/// The projection of a negative gradient d onto a cone, and its multipliers:
///     direction = -(d + E' equality + G' inequality),  inequality >= 0.
struct ConeProjection {
  RationalVector direction, equality, inequality;
};

/// Projects -gradient onto the cone E p = 0, G p <= 0. The method is the
/// nonnegative least squares min |d + E' l + G' m|^2, m >= 0. It ends, because
/// the norm falls with each row that is added.
///
/// Source: Lawson and Hanson, "Solving least squares problems", 1974, chapter
/// 23, algorithm NNLS.
ConeProjection ProjectOntoCone(const RationalVector& gradient,
                               const RationalMatrix& E,
                               const RationalMatrix& G);

}  // namespace poise
