// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// TwoDoubles is the number near + rest, where near is the double closest to
/// it.
struct TwoDoubles {
  double near, rest;
};

/// Computes a'b with an error of 2^-100 |a| |b|: cancellation costs no digits.
/// Returns NaN if a'b overflows or an entry is not finite. About 30 flops.
///
/// Source: Ogita, Rump and Oishi, "Accurate sum and dot product", SIAM Journal
/// on Scientific Computing 26(6), 2005, algorithm 5.3.
inline TwoDoubles ExactDot(const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b) noexcept {
  double sum = a[0] * b[0];
  double rest = std::fma(a[0], b[0], -sum);
  for (int i = 1; i < 3; ++i) {
    const double product = a[i] * b[i];
    const double before = sum;
    sum = before + product;
    // The rounding errors of the sum and of the product; both are exact.
    const double added = sum - before;
    rest += (before - (sum - added)) + (product - added);
    rest += std::fma(a[i], b[i], -product);
  }
  const double near = sum + rest;
  return {near, rest - (near - sum)};
}

}  // namespace poise
