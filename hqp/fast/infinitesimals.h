// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cmath>

/// These functions compute with numbers m_0 + m_1 e + m_2 e^2 + ..., where e >
/// 0 is infinitesimal. The first `size` coefficients are stored. A hierarchy is
/// the limit of one least-squares problem in which level k has the weight e^k.
/// So the multipliers of a row on all levels are the coefficients of one such
/// number.
namespace poise::infinitesimals {

/// A sum below this is zero, relative to its largest term: the rounding of a
/// division and of ten additions, times ten.
constexpr double kRounding = 1e-14;

/// Returns the sign of the first coefficient that is not zero, or 0.
inline int Sign(const double* m, int size) {
  for (int k = 0; k < size; ++k) {
    if (m[k] != 0) return m[k] > 0 ? 1 : -1;
  }
  return 0;
}

inline bool IsLess(const double* a, const double* b, int size) {
  return std::lexicographical_compare(a, a + size, b, b + size);
}

/// Computes the time t at which a number that is m at t = 0 and `end` at t = 1,
/// and linear in t, is zero: t = m / (m - end). pre: m >= 0 > end.
/// @param rest  memory for `size` numbers.
inline void FindZero(const double* m, const double* end, int size, double* rest,
                     double* t) {
  int lowest = 0;  // The order of m - end.
  while (m[lowest] == end[lowest]) ++lowest;
  std::copy_n(m, size, rest);
  std::fill_n(t, size, 0);
  for (int k = 0; k + lowest < size; ++k) {
    t[k] = rest[k + lowest] / (m[lowest] - end[lowest]);
    for (int l = lowest; k + l < size; ++l) {
      rest[k + l] -= t[k] * (m[l] - end[l]);
    }
  }
}

/// Returns the first coefficient of the time that FindZero() computes.
/// pre: m >= 0 > end.
inline double FirstOfZero(const double* m, const double* end) {
  while (*m == *end) ++m, ++end;
  return *m / (*m - *end);
}

/// m += t (end - m). A coefficient that is rounding of its terms becomes zero.
inline void Approach(const double* t, const double* end, int size, double* m) {
  // The last coefficient of t that is not zero. Mostly, t is a plain number.
  int highest = size - 1;
  while (highest > 0 && t[highest] == 0) --highest;
  for (int k = size - 1; k >= 0; --k) {
    double sum = m[k], largest = std::abs(m[k]);
    for (int l = std::max(k - highest, 0); l <= k; ++l) {
      const double term = t[k - l] * (end[l] - m[l]);
      sum += term;
      largest = std::max(largest, std::abs(term));
    }
    m[k] = std::abs(sum) <= kRounding * largest ? 0 : sum;
  }
}

}  // namespace poise::infinitesimals
