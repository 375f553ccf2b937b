// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "poise/hqp/aligned_doubles.h"
#include "poise/math/eigen_alignment.h"

namespace poise {

using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Largest numbers of rows of a level.
struct LevelCapacity {
  int equalities = 0;
  int inequalities = 0;
};

/// Returns the largest number of rows of all levels together.
int NumRows(const std::vector<LevelCapacity>& capacity);

/// The columns first <= j < first + size of a row. All others are zero.
struct Span {
  int first = 0, size = 0;
};

/// A block of rows B y + b = 0, in the least-squares sense, with one weight per
/// row. The cost of the level has the term 1/2 sum_i weight_i (B_i y + b_i)^2.
struct EqualityBlock {
  Eigen::Map<RowMajorMatrix> B;
  Eigen::Map<Eigen::VectorXd> b;
  Eigen::Map<Eigen::VectorXd> weight;
  Span* span;  ///< By row; see Hierarchy::FindSpans().

  /// Writes a row of B with one entry. Its other entries must still be zero.
  void SetSingle(int row, int column, double value) noexcept {
    B(row, column) = value;
    span[row] = {column, 1};
  }
};

/// A block of rows lower <= C y <= upper; an infinite side is absent. A y + a
/// <= 0 is C = A, lower = -inf, upper = -a. The slack of a row is its
/// violation, max(lower - C y, C y - upper, 0). The cost of the level has half
/// the squared slack.
struct InequalityBlock {
  Eigen::Map<RowMajorMatrix> C;
  Eigen::Map<Eigen::VectorXd> lower;
  Eigen::Map<Eigen::VectorXd> upper;
  Span* span;  ///< By row; see Hierarchy::FindSpans().

  /// Writes a row of C with one entry. Its other entries must still be zero.
  void SetSingle(int row, int column, double value) noexcept {
    C(row, column) = value;
    span[row] = {column, 1};
  }
};

/// A stack of levels of rows, highest priority first: the problem of the paper,
/// (1)-(6). The constructor allocates all memory. At each tick the caller
/// clears the hierarchy and adds the blocks again.
class Hierarchy {
 public:
  /// Allocates memory for all levels at their capacity. Throws
  /// std::invalid_argument if a number is negative, as does the next
  /// constructor.
  Hierarchy(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Allocates memory for `total` rows, which the levels share. If that is less
  /// than all levels at their capacity, no level has rows before
  /// Clear(num_levels, rows).
  Hierarchy(int num_variables, const std::vector<LevelCapacity>& capacity,
            const LevelCapacity& total);

  int num_variables() const { return num_variables_; }
  int num_levels() const { return used_levels_; }

  /// Removes all rows, and sets the number of levels, at most the capacity's.
  /// Each level may get rows up to its capacity. pre: there is memory for all
  /// of these rows (asserted).
  void Clear(int num_levels) noexcept;

  /// Removes all rows as well, and level k may get at most rows[k], k <
  /// num_levels. pre: there is memory for all of these rows (asserted).
  void Clear(int num_levels, const LevelCapacity* rows) noexcept;

  /// Returns the next rows of a level: B, b and C zero, weights 1, bounds
  /// infinite. Valid until Clear(). pre: the level gets at most the rows that
  /// Clear() allows (asserted).
  EqualityBlock AddEqualities(int level, int rows) noexcept;
  InequalityBlock AddInequalities(int level, int rows) noexcept;

  /// Finds the first and the last nonzero column of each row whose span is all
  /// columns, so that the solver and the certificate skip the zeros before and
  /// after. Without this call, only rows written by SetSingle() have a shorter
  /// span. Write no row after the call, until Clear().
  /// pre: a row with a shorter span is zero outside it (asserted). If it is
  /// not, no answer is certified.
  void FindSpans() noexcept;

  int num_equalities(int level) const { return levels_[level].equalities; }
  int num_inequalities(int level) const { return levels_[level].inequalities; }

  /// Returns the rows of a level.
  Eigen::Map<const RowMajorMatrix> B(int level) const {
    const Level& of = levels_[level];
    return {B_.data() + Size(of.first_equality), of.equalities, num_variables_};
  }
  Eigen::Map<const Eigen::VectorXd> b(int level) const {
    const Level& of = levels_[level];
    return {b_.data() + of.first_equality, of.equalities};
  }
  Eigen::Map<const Eigen::VectorXd> weight(int level) const {
    const Level& of = levels_[level];
    return {weight_.data() + of.first_equality, of.equalities};
  }
  Eigen::Map<const RowMajorMatrix> C(int level) const {
    const Level& of = levels_[level];
    return {C_.data() + Size(of.first_inequality), of.inequalities,
            num_variables_};
  }
  Eigen::Map<const Eigen::VectorXd> lower(int level) const {
    const Level& of = levels_[level];
    return {lower_.data() + of.first_inequality, of.inequalities};
  }
  Eigen::Map<const Eigen::VectorXd> upper(int level) const {
    const Level& of = levels_[level];
    return {upper_.data() + of.first_inequality, of.inequalities};
  }
  /// Returns the spans of the rows of B and C: an array by row of the level.
  const Span* B_span(int level) const {
    return B_span_.data() + levels_[level].first_equality;
  }
  const Span* C_span(int level) const {
    return C_span_.data() + levels_[level].first_inequality;
  }

 private:
  struct Level {
    int first_equality = 0, first_inequality = 0;
    int equalities = 0, inequalities = 0;
    LevelCapacity most;  ///< See Clear().
  };
  /// Number of entries of so many rows: the index of the next row in B_ and C_.
  std::size_t Size(int rows) const {
    return static_cast<std::size_t>(rows) * num_variables_;
  }

  int num_variables_;
  std::vector<LevelCapacity> capacity_;
  int used_levels_ = 0;
  std::vector<Level> levels_;
  /// The rows of all levels, one after the other.
  AlignedDoubles B_, C_;
  Eigen::VectorXd b_, weight_, lower_, upper_;
  std::vector<Span> B_span_, C_span_;
};

}  // namespace poise
