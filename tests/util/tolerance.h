// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Returns the expected rounding error of a sum of n terms,
///     8 n eps condition scale,
/// for tests that compute the same number in two ways.
///
/// @param scale      norm of the terms, in the unit of the result.
/// @param n          number of terms, or size of the matrix.
/// @param condition  condition number of the solved system, 1 if there is none.
///
/// The environment variable POISE_TOLERANCE_SCALE multiplies the result: with 0
/// every comparison fails and prints its true residual.
double Rounding(double scale, int n, double condition = 1);

}  // namespace poise
