// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstring>
#include <vector>

#include "poise/hqp/solution.h"

namespace poise {

/// Returns whether two working sets of a level are the same. operator==
/// compares row by row, which takes 1 % of a solve.
inline bool AreSame(const std::vector<Side>& side,
                    const std::vector<Side>& other) {
  if (side.size() != other.size()) return false;
  return side.empty() || std::memcmp(side.data(), other.data(),
                                     side.size() * sizeof(Side)) == 0;
}

}  // namespace poise
