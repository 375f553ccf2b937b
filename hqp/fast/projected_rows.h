// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/aligned_doubles.h"

namespace poise {

/// Rows of unit length, each split by an orthonormal basis Q into coefficients
/// l and a remainder: r = l Q + remainder, with Q remainder = 0. The split
/// follows each change of the basis, which costs less than another projection.
/// Nothing allocates after construction.
///
/// Rows are named by keys, 0 to num_keys - 1. There is room for max_rows of
/// them. `rank` is the number of rows of Q, at most num_variables.
class ProjectedRows {
 public:
  ProjectedRows(int num_variables, int num_keys, int max_rows);

  /// Removes all rows, and sets the rank.
  void Clear(int rank);

  /// Adds a row that is not there yet, by its split. Returns false if there is
  /// no room.
  bool Add(int key, const double* coefficients, const double* remainder);

  /// Copies the split of a row, and marks it as used. Returns false if the row
  /// is not there.
  [[nodiscard]] bool Use(int key, double* coefficients, double* remainder);

  /// Marks a row as used, if it is there.
  void Keep(int key) {
    if (slot_[key] >= 0) is_used_[slot_[key]] = true;
  }

  /// Removes all rows that are not marked as used, and all marks. Added rows
  /// are marked.
  void KeepUsed();

  /// Q gets a last row q, which has `columns` entries and is zero behind them.
  void Extend(const double* q, int columns);

  /// The rotation of kernels::Rotate() is applied to rows e and e + 1 of Q.
  void Rotate(int e, double c, double s);

  /// The last row q of Q, which is zero behind its `columns` entries, is
  /// removed.
  void RemoveLast(const double* q, int columns);

  /// Rows e and f of Q are swapped.
  void Swap(int e, int f);

  /// Row e of Q is negated.
  void Negate(int e);

  /// Column `from` of the remainders replaces column `to`, and stays as it is.
  void MoveColumn(int from, int to);

  /// Sets a column of the remainders to zero.
  void SetZero(int column);

  int rank() const { return rank_; }
  int size() const { return size_; }

 private:
  double* remainder(int slot) {
    return remainder_.data() + Index(slot, stride_);
  }
  double* coefficients(int e) { return l_.data() + Index(e, slot_stride_); }
  static std::size_t Index(int i, int stride) {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(stride);
  }

  int n_, stride_, max_rows_;
  int slot_stride_;  ///< max_rows_ rounded up, so that rows of l_ are aligned.
  int rank_ = 0, size_ = 0;
  std::vector<int> slot_;      ///< By key; -1: not there.
  std::vector<int> key_;       ///< By slot.
  std::vector<bool> is_used_;  ///< By slot.
  AlignedDoubles remainder_;   ///< max_rows x stride, by slot.
  AlignedDoubles l_;           ///< n x slot stride: columns are slots.
  AlignedDoubles factor_;      ///< By slot.
};

}  // namespace poise
