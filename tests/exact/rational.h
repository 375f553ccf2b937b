// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <vector>

namespace poise {

/// A fraction of two integers of any length. Its arithmetic has no rounding.
using Rational = mpq_class;
using RationalVector = std::vector<Rational>;

/// A matrix as a list of rows of equal length.
using RationalMatrix = std::vector<RationalVector>;

/// Returns a'b.
Rational Dot(const RationalVector& a, const RationalVector& b);

/// Adds factor * a to *sum, which has the same size.
void AddTo(const Rational& factor, const RationalVector& a,
           RationalVector* sum);

/// Returns whether all entries are zero.
bool IsZero(const RationalVector& a);

/// Solves A x = b by Gaussian elimination. A may have any shape and rank. If x
/// is not unique, the variables without a pivot are zero. Returns nothing if no
/// x exists.
std::optional<RationalVector> SolveLinear(RationalMatrix A, RationalVector b,
                                          int num_variables);

}  // namespace poise
