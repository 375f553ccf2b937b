// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/lexicographic_factorization.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/math/rank.h"

namespace poise {
namespace {

using kernels::AddRows;
using kernels::AddToRows;
using kernels::Dots;
using kernels::SquaredNorm;

}  // namespace

LexicographicFactorization::LexicographicFactorization(int num_variables,
                                                       int max_rows,
                                                       int max_levels,
                                                       int max_kept_rows)
    : n_(num_variables),
      stride_((num_variables + 7) / 4 * 4),
      variables_(num_variables),
      kept_(num_variables, max_rows, max_kept_rows) {
  const auto rows = [&](int count) {
    return static_cast<size_t>(count) * stride_;
  };
  levels_.reserve(max_levels);
  work_.resize(rows(max_rows));
  l_.resize(rows(max_rows));
  q_.resize(rows(n_));
  effective_.resize(rows(n_));
  z_.resize(n_);
  target_.resize(max_rows);
  metric_.resize(max_rows);
  residual_.resize(max_rows);
  rest_.resize(max_rows);
  fresh_.resize(max_rows);
  carrier_.resize(n_);
  reflection_.resize(static_cast<size_t>(n_) * max_rows);
  factor_.resize(std::max(max_rows, stride_));
  scratch_.resize(std::max(max_rows, stride_));
  packed_.resize(n_);
  is_pivot_.resize(max_rows);
  open_.resize(max_rows);
  nonzero_.resize(max_rows);
  key_.resize(max_rows);
  is_recalled_.resize(max_rows);
}

void LexicographicFactorization::Truncate(int level) {
  levels_.resize(std::min<size_t>(levels_.size(), level));
  num_rows_ = levels_.empty() ? 0 : levels_.back().end_row;
  rank_ = levels_.empty() ? 0 : levels_.back().rank_end;
  if (level < num_merged_) num_merged_ = 0;
  if (level == 0 || rank_ < kept_.rank()) kept_.Clear(rank_);
  if (level == 0 || rank_ < variables_.size()) variables_.Clear();
}

int LexicographicFactorization::AddRow(double target, double metric) {
  target_[num_rows_] = target;
  metric_[num_rows_] = metric;
  key_[num_rows_] = kNoKey;
  return num_rows_++;
}

void LexicographicFactorization::SetRow(int a, const double* from, int first,
                                        int end, double norm) {
  double* to = row(a);
  std::fill_n(to, n_, 0);
  // Products with the reciprocal are rounded twice. At degenerate vertices,
  // warm starts would then need iterations
  // (docs/notebook/2026-11-30-rows-without-calls.md).
  kernels::Divide(from + first, norm, end - first, scratch_.data());
  for (int j = first; j < end; ++j) {
    to[variables_.column(j)] = scratch_[j - first];
  }
}

bool LexicographicFactorization::Recall(int a, int key) {
  if (rank_ == n_) {
    kept_.Keep(key);
    return false;
  }
  key_[a] = key;
  is_recalled_[a] = kept_.Use(key, l_row(a), row(a));
  return is_recalled_[a];
}

bool LexicographicFactorization::is_deficient(int level) const {
  return levels_[level].deficient;
}

bool LexicographicFactorization::is_well_conditioned() const {
  if (rank_ < num_rows_) return false;
  for (int e = 0; e < rank_; ++e) {
    if (std::abs(effective_[static_cast<size_t>(e) * (stride_ + 1)]) <
        tolerances::kIndependentPart) {
      return false;
    }
  }
  return true;
}

void LexicographicFactorization::FactorLevel() {
  Level level;
  level.first_row = levels_.empty() ? 0 : levels_.back().end_row;
  level.end_row = num_rows_;
  level.rank_begin = level.rank_end = rank_;
  if (IsDetermined(level)) {
    level.deficient = level.end_row > level.first_row;
  } else {
    FactorRows(&level);
    if (IsLate()) {
      Truncate(num_levels());
      return;
    }
  }
  SolveLevel(level);
  levels_.push_back(level);
}

void LexicographicFactorization::FactorRows(Level* level) {
  for (int a = level->first_row; a < level->end_row; ++a) ProjectRow(a);
  PivotRows(level);
  const int rows = level->end_row - level->first_row;
  level->deficient = level->rank_end - level->rank_begin < rows;
  rank_ = level->rank_end;
  if (level->deficient) {
    Reduce(level);
  } else {
    CopyEffective(*level);
  }
}

// Each row of a level that is not deficient is an effective row.
void LexicographicFactorization::CopyEffective(const Level& level) {
  for (int e = level.rank_begin; e < level.rank_end; ++e) {
    std::copy_n(l_row(carrier_[e]), e + 1, effective(e));
  }
}

// Projects row a once onto the complement of the levels before.
void LexicographicFactorization::ProjectRow(int a) {
  double* l = l_row(a);
  int begin = kept_.rank();
  if (key_[a] == kNoKey) {
    begin = variables_.size();
    TakeOutFixed(row(a), l);
  } else if (!is_recalled_[a]) {
    ProjectKept(a);
  }
  std::fill(l + begin, l + rank_, 0);
  TakeOut(begin, rank_, row(a), l);
  rest_[a] = SquaredNorm(row(a), variables_.num_free());
}

// Projects row a onto the complement of the merged levels, and keeps that.
void LexicographicFactorization::ProjectKept(int a) {
  double* l = l_row(a);
  const int begin = variables_.size();
  TakeOutFixed(row(a), l);
  std::fill(l + begin, l + kept_.rank(), 0);
  TakeOut(begin, kept_.rank(), row(a), l);
  if (SquaredNorm(row(a), variables_.num_free()) <
      tolerances::kReorthogonalize * tolerances::kReorthogonalize) {
    TakeOut(begin, kept_.rank(), row(a), l);
  }
  (void)kept_.Add(key_[a], l, row(a));
}

// Moves the entries of x in the columns of the fixed variables to l.
void LexicographicFactorization::TakeOutFixed(double* x, double* l) {
  for (int e = 0; e < variables_.size(); ++e) {
    l[e] = x[variables_.fixed_column(e)];
    x[variables_.fixed_column(e)] = 0;
  }
}

// Subtracts the projection on the rows of Q from `begin` to `end` from x, and
// adds its coefficients to l. None of these rows fixes a variable.
void LexicographicFactorization::TakeOut(int begin, int end, double* x,
                                         double* l) {
  if (begin >= end) return;
  const int columns = variables_.num_free();
  Dots(q(begin), stride_, end - begin, x, columns, scratch_.data());
  for (int e = begin; e < end; ++e) {
    l[e] += scratch_[e - begin];
    scratch_[e - begin] = -scratch_[e - begin];
  }
  AddRows(q(begin), stride_, end - begin, scratch_.data(), columns, x);
  Count(2 * (end - begin), columns);
}

// Counts multiply-adds: one for each entry of `rows` rows, and kRowOverhead a
// row.
void LexicographicFactorization::Count(int rows, int columns) {
  multiply_adds_ +=
      static_cast<std::int64_t>(rows) * (columns + kernels::kRowOverhead);
}

// Orthogonalises the remainders of the level's rows, the largest weighted one
// first, until each is zero. A row that depends on large-weight rows then
// depends on them exactly. Otherwise the rounding of its remainder, times an
// unattainable residual, could outweigh a small-weight row.
void LexicographicFactorization::PivotRows(Level* level) {
  const int columns = variables_.num_free();
  int open = 0;  // Rows that are neither orthogonalised nor zero.
  const int rows = level->end_row - level->first_row;
  const int most = std::min(rows, n_ - level->rank_begin);
  for (int a = level->first_row; a < level->end_row; ++a) {
    std::fill_n(l_row(a) + level->rank_begin, most, 0);
    open_[open++] = a;
    fresh_[a] = rest_[a];  // As last computed, not downdated.
  }
  while (level->rank_end < n_ && !IsLate()) {
    const int pivot = TakePivot(&open);
    if (pivot < 0) break;
    const int e = level->rank_end;
    double* q = this->q(e);
    double* l = l_row(pivot);
    std::copy_n(row(pivot), columns, q);
    if (rest_[pivot] <
        tolerances::kReorthogonalize * tolerances::kReorthogonalize) {
      // A kept remainder is orthogonal to the merged levels already, but its
      // rounding grows as the remainder gets smaller.
      const bool is_clean = key_[pivot] != kNoKey &&
                            rest_[pivot] >= tolerances::kCleanRemainder *
                                                tolerances::kCleanRemainder;
      TakeOut(is_clean ? kept_.rank() : variables_.size(), e, q, l);
    }
    const double norm = std::sqrt(SquaredNorm(q, columns));
    if (norm <= kRankTolerance) {
      // The remainder was rounding of other rows. The row is dependent.
      rest_[pivot] = 0;
      continue;
    }
    l[e] = norm;
    kernels::Scale(q, 1 / norm, columns, q);
    carrier_[e] = pivot;
    ++level->rank_end;
    // Update the other rows: coefficient, remainder, and squared norm.
    Dots(row(0), stride_, open_.data(), open, q, columns, factor_.data());
    for (int i = 0; i < open; ++i) {
      const int a = open_[i];
      l_row(a)[e] = factor_[i];
      rest_[a] -= factor_[i] * factor_[i];
      factor_[i] = -factor_[i];
    }
    AddToRows(row(0), stride_, open_.data(), open, factor_.data(), q, columns);
    Count(2 * open + 1, columns);
    for (int i = 0; i < open; ++i) {
      const int a = open_[i];
      // The difference of squares has lost its digits: compute the norm again.
      if (rest_[a] < tolerances::kDowndate * fresh_[a]) {
        rest_[a] = SquaredNorm(row(a), columns);
        fresh_[a] = rest_[a];
      }
    }
  }
}

// Removes the row with the largest weighted remainder, and rows whose remainder
// is zero, from the first `open` of open_. Returns this row, or -1 if all are
// zero.
int LexicographicFactorization::TakePivot(int* open) {
  int pivot = -1, at = 0, left = 0;
  double largest = 0;
  for (int i = 0; i < *open; ++i) {
    const int a = open_[i];
    if (rest_[a] <= kRankTolerance * kRankTolerance) continue;
    const double weighted = weight(a) * rest_[a];
    if (pivot < 0 || weighted > largest) {
      pivot = a;
      at = left;
      largest = weighted;
    }
    open_[left++] = a;
  }
  if (pivot >= 0) {
    std::copy(open_.data() + at + 1, open_.data() + left, open_.data() + at);
    --left;
  }
  *open = left;
  return pivot;
}

// Reduces the rows d_a l_a of a deficient level by reflections H, in the
// level's own columns, from the last one to the first. The result is lower
// triangular:
//     H D L = [effective rows; zeros].
// These rows replace the remainders, which are not needed any more. The columns
// before are not reflected: SolveRows() and SolveDual() take them from L.
void LexicographicFactorization::Reduce(Level* level) {
  const int first = level->first_row, rows = level->end_row - first;
  const int begin = level->rank_begin, end = level->rank_end;
  for (int i = 0; i < rows; ++i) {
    const int a = first + i;
    double* to = row(a);
    for (int e = begin; e < end; ++e) {
      to[e] = metric_[a] * l_row(a)[e];
    }
    is_pivot_[a] = false;
  }
  for (int e = begin; e < end; ++e) is_pivot_[carrier_[e]] = true;
  // The rows that may contain column e, in order. Rows that were orthogonalised
  // before row e do not. PivotRows() does not need its list any more.
  int* const open = open_.data();
  int count = 0;
  for (int i = 0; i < rows; ++i) {
    if (!is_pivot_[first + i]) open[count++] = i;
  }
  for (int e = end - 1; e >= begin && !IsLate(); --e) {
    const int added = carrier_[e] - first;
    int* const to = std::lower_bound(open, open + count, added);
    std::copy_backward(to, open + count, open + count + 1);
    *to = added;
    ++count;
    const int carrier = ReduceColumn(*level, e, count);
    std::remove(open, open + count, carrier);
    --count;
    carrier_[e] = first + carrier;
    std::copy(row(first + carrier) + begin, row(first + carrier) + e + 1,
              effective(e) + begin);
  }
}

// Reflects the first `count` rows of open_, which are all that may contain
// column e, so that column e is zero but in the row where its entry is largest.
// Returns this row.
int LexicographicFactorization::ReduceColumn(const Level& level, int e,
                                             int count) {
  double* first = row(level.first_row);
  double* v = reflection(e);
  std::fill_n(v, level.end_row - level.first_row, 0);
  int pivot = open_[0], terms = 0;
  double squares = 0;
  for (int k = 0; k < count; ++k) {
    const int i = open_[k];
    v[i] = first[static_cast<size_t>(i) * stride_ + e];
    squares += v[i] * v[i];
    if (v[i] != 0) nonzero_[terms++] = i;
    if (std::abs(v[i]) > std::abs(v[pivot])) pivot = i;
  }
  const double alpha = v[pivot] > 0 ? -std::sqrt(squares) : std::sqrt(squares);
  const double length = squares - alpha * v[pivot];  // v'v / 2 below.
  v[pivot] -= alpha;
  if (length == 0) return pivot;
  const double root = std::sqrt(length);  // So that H = I - v v'.
  const int columns = e + 1 - level.rank_begin;
  for (int k = 0; k < terms; ++k) {
    double& entry = v[nonzero_[k]];
    entry /= root;
    factor_[k] = entry;
  }
  std::fill_n(scratch_.data(), columns, 0);
  AddRows(first + level.rank_begin, stride_, nonzero_.data(), terms,
          factor_.data(), columns, scratch_.data());
  for (int k = 0; k < terms; ++k) factor_[k] = -factor_[k];
  AddToRows(first + level.rank_begin, stride_, nonzero_.data(), terms,
            factor_.data(), scratch_.data(), columns);
  Count(2 * terms, columns);
  return pivot;
}

}  // namespace poise
