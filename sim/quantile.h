// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace poise {

/// The smallest of some values such that a fraction of all, 0 to 1, is no larger:
/// one of them, and nothing between two. Orders them anew. pre: there is one.
template <typename Number>
Number Quantile(std::vector<Number>* values, double fraction) {
  const auto rank = static_cast<std::size_t>(
      std::ceil(fraction * static_cast<double>(values->size())));
  const auto at = values->begin() + (rank > 0 ? rank - 1 : 0);
  std::nth_element(values->begin(), at, values->end());
  return *at;
}

}  // namespace poise
