// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// Sines and cosines of n angles, several at a time: four times as fast as
/// std::sin() and std::cos() where the machine has wide registers.
///
/// @param x  n angles, rad; of any size. Not finite gives NaN.
/// @param sine, cosine  n each; must not overlap x. Error below 1 ulp while
///     |x| <= 10000 rad; beyond, that of std::sin() and std::cos().
/// Does not allocate, does not throw.
void SinCos(const double* x, int n, double* sine, double* cosine) noexcept;

}  // namespace poise
