// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace poise {

/// An order of the variables, in which those that one row alone determines, the
/// fixed ones, come last. The e-th fixed variable has column n - 1 - e, and the
/// free variables have the columns before. So a matrix over the free variables
/// is a leading block, and it changes by one column when a variable is fixed or
/// released.
class FixedVariables {
 public:
  explicit FixedVariables(int num_variables)
      : column_(num_variables), variable_(num_variables) {
    Clear();
  }

  /// Releases all variables. Each then has the column of its own number.
  void Clear() {
    size_ = 0;
    std::iota(column_.begin(), column_.end(), 0);
    std::iota(variable_.begin(), variable_.end(), 0);
  }

  int size() const { return size_; }
  int num_free() const { return static_cast<int>(column_.size()) - size_; }

  int column(int variable) const { return column_[variable]; }
  int variable(int column) const { return variable_[column]; }
  /// Column of the e-th fixed variable.
  int fixed_column(int e) const {
    return static_cast<int>(column_.size()) - 1 - e;
  }
  int fixed_variable(int e) const { return variable_[fixed_column(e)]; }
  bool is_fixed(int variable) const { return column_[variable] >= num_free(); }

  /// Fixes a free variable, as the last one. The last free variable gets the
  /// column that this variable had. Returns that column.
  int Fix(int variable) {
    const int column = column_[variable];
    SwapColumns(column, fixed_column(size_++));
    return column;
  }

  /// Releases the e-th fixed variable. The last fixed one gets the number e.
  /// The released variable gets the last free column.
  void Release(int e) {
    SwapColumns(fixed_column(e), fixed_column(size_ - 1));
    --size_;
  }

 private:
  void SwapColumns(int c, int d) {
    std::swap(variable_[c], variable_[d]);
    column_[variable_[c]] = c;
    column_[variable_[d]] = d;
  }

  int size_;
  std::vector<int> column_;    ///< By variable.
  std::vector<int> variable_;  ///< By column.
};

}  // namespace poise
