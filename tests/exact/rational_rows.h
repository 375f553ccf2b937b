// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/tests/exact/rational.h"

namespace poise {

/// The rows of one level of a hierarchy, without rounding.
struct RationalRows {
  RationalMatrix B;
  RationalVector b, weight;
  RationalMatrix C;
  std::vector<std::optional<Rational>> lower, upper;  ///< Empty: no bound.
};

/// Returns the levels of a hierarchy, and as one more level the rows y = 0,
/// whose optimum has minimum norm. A double is an integer times a power of two,
/// so that the conversion is exact.
/// Throws std::invalid_argument if CheckInput() finds an error.
std::vector<RationalRows> MakeRationalRows(const Hierarchy& hierarchy);

/// Returns the signed violation of inequality i at y: positive above the upper
/// bound, negative below the lower bound, else zero.
Rational Violation(const RationalRows& rows, int i, const RationalVector& y);

/// Returns 1/2 (sum weight (B y + b)^2 + |slack|^2).
Rational CostAt(const RationalRows& rows, const RationalVector& y);

}  // namespace poise
