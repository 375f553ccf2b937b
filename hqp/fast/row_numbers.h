// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// Stores a number of `size` coefficients for some of the inequality rows. A
/// working set has far fewer rows than all levels have room for, so a row gets
/// its memory when it is first used. Nothing allocates after construction.
class RowNumbers {
 public:
  /// @param max_rows  largest number of rows with a number at the same time.
  ///                  The numbers of further rows are always zero.
  RowNumbers(const std::vector<LevelCapacity>& capacity, int max_rows, int size)
      : size_(size),
        numbers_(static_cast<std::size_t>(max_rows) * size),
        free_(max_rows),
        zero_(size) {
    for (const LevelCapacity& level : capacity) {
      place_.emplace_back(level.inequalities, kNoPlace);
    }
    Clear();
  }

  /// Removes all numbers.
  void Clear() {
    for (std::vector<std::int16_t>& level : place_) {
      std::fill(level.begin(), level.end(), kNoPlace);
    }
    std::iota(free_.begin(), free_.end(), 0);
    num_free_ = static_cast<int>(free_.size());
  }

  /// Returns the number of a row, which is zero if the row had none.
  double* At(int level, int row) {
    std::int16_t& place = place_[level][row];
    if (place == kNoPlace) {
      if (num_free_ == 0) {
        std::fill(zero_.begin(), zero_.end(), 0);
        return zero_.data();
      }
      place = free_[--num_free_];
      std::fill_n(At(place), size_, 0);
    }
    return At(place);
  }

  /// Removes the number of a row, if it has one.
  void Remove(int level, int row) {
    std::int16_t& place = place_[level][row];
    if (place == kNoPlace) return;
    free_[num_free_++] = place;
    place = kNoPlace;
  }

 private:
  static constexpr std::int16_t kNoPlace = -1;
  double* At(std::int16_t place) {
    return numbers_.data() + static_cast<std::size_t>(place) * size_;
  }

  int size_, num_free_ = 0;
  std::vector<double> numbers_;
  std::vector<std::int16_t> free_;
  std::vector<double> zero_;
  std::vector<std::vector<std::int16_t>> place_;  ///< By level and row.
};

}  // namespace poise
