// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/simd/sin_cos.h"

#include <cmath>

#include "poise/dynamics/simd/lanes.h"
#include "poise/math/target_clones.h"

namespace poise {
namespace {

// Adding and subtracting kRound rounds a double below 2^51 to an integer.
constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52.

// The sum of the three parts is pi/2. The first two parts have 33 bits each, so
// that their products with an integer below 2^20 are exact.
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
// Up to this angle, in rad, the error is below 1 ulp.
constexpr double kLargest = 10000;

constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

}  // namespace

POISE_TARGET_CLONES("avx2")
void SinCos(const double* x, int n, double* sine, double* cosine) noexcept {
  POISE_LANES
  for (int i = 0; i < n; ++i) {
    // x = quarter pi/2 + y + z, |y| <= pi/4, where z is the rounding error of
    // y.
    const double quarter = (x[i] * kTwoOverPi + kRound) - kRound;
    const double a = x[i] - quarter * kHalfPi1;
    const double b = quarter * kHalfPi2;
    const double c = a - b;
    const double y = c - quarter * kHalfPi3;
    const double z = ((a - c) - b) + ((c - y) - quarter * kHalfPi3);

    // Taylor series; the omitted terms are below 2e-18:
    //     sin y = y + y^3 odd(y^2),   cos y = 1 - y^2/2 + y^4 even(y^2).
    const double yy = y * y;
    double odd = 1 / 355687428096000.;
    odd = odd * yy - 1 / 1307674368000.;
    odd = odd * yy + 1 / 6227020800.;
    odd = odd * yy - 1 / 39916800.;
    odd = odd * yy + 1 / 362880.;
    odd = odd * yy - 1 / 5040.;
    odd = odd * yy + 1 / 120.;
    odd = odd * yy - 1 / 6.;
    double even = 1 / 20922789888000.;
    even = even * yy - 1 / 87178291200.;
    even = even * yy + 1 / 479001600.;
    even = even * yy - 1 / 3628800.;
    even = even * yy + 1 / 40320.;
    even = even * yy - 1 / 720.;
    even = even * yy + 1 / 24.;

    // To first order in z, sin(y + z) = sin y + z cos y and cos(y + z) = cos y
    // - z sin y. Small terms are added first.
    const double half = 0.5 * yy;
    const double one = 1 - half;
    const double sine_y = y + (one * z + y * yy * odd);
    const double cosine_y = one + (((1 - one) - half) - y * z + yy * yy * even);

    // The turn is quarter modulo 4: 0, 1, 2 or -2, -1. With s = sin(y + z) and
    // c = cos(y + z) the sine is s, c, -s, -c and the cosine c, -s, -c, s.
    const double turn = quarter - 4 * ((0.25 * quarter + kRound) - kRound);
    const bool swap = turn * turn == 1;
    const double sine_size = swap ? cosine_y : sine_y;
    const double cosine_size = swap ? sine_y : cosine_y;
    sine[i] = turn * turn == 4 || turn == -1 ? -sine_size : sine_size;
    cosine[i] = turn * turn == 4 || turn == 1 ? -cosine_size : cosine_size;
  }
  // Larger angles, and NaN, need the exact reduction of the standard library.
  for (int i = 0; i < n; ++i) {
    if (std::abs(x[i]) <= kLargest) continue;
    sine[i] = std::sin(x[i]);
    cosine[i] = std::cos(x[i]);
  }
}

}  // namespace poise
