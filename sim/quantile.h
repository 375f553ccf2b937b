// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace poise {

/// Returns the smallest of the values such that at least a fraction, 0 to 1, of
/// all values is less than or equal to it. The result is one of the values,
/// without interpolation. Reorders the values. pre: there is at least one
/// value.
template <typename Number>
Number Quantile(std::vector<Number>* values, double fraction) {
  const auto rank = static_cast<std::size_t>(
      std::ceil(fraction * static_cast<double>(values->size())));
  const auto at = values->begin() + (rank > 0 ? rank - 1 : 0);
  std::nth_element(values->begin(), at, values->end());
  return *at;
}

}  // namespace poise
