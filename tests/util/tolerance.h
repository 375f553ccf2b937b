// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// The rounding error to expect of a sum of n terms,
///     8 n eps condition scale,
/// for tests that compare two ways to the same number.
///
/// @param scale      the norm of what was added up, in the unit of the result.
/// @param n          how many terms were added up, or the size of the matrix.
/// @param condition  of the system that was solved; 1 where none was.
///
/// The environment variable POISE_TOLERANCE_SCALE multiplies it: with 0 every
/// comparison fails and prints its true residual.
double Rounding(double scale, int n, double condition = 1);

}  // namespace poise
