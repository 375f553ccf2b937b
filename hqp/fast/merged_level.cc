// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// LexicographicFactorization, second part: the merged level, to which rows are
// added and removed one by one.
#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {

using kernels::SquaredNorm;

int LexicographicFactorization::AddFixedVariable(int variable, double entry,
                                                 double target, double metric) {
  const int a = AddRow(target, metric);
  std::fill_n(effective(rank_), rank_, 0);
  effective(rank_)[rank_] = entry;
  carrier_[rank_++] = a;
  variables_.Fix(variable);
  return a;
}

bool LexicographicFactorization::FactorMerged(int level) {
  Level rest = {rank_, num_rows_, rank_, rank_, false};
  for (int a = rest.first_row; a < rest.end_row; ++a) ProjectRow(a);
  PivotRows(&rest);
  rank_ = rest.rank_end;
  CopyEffective(rest);
  if (!is_well_conditioned()) {
    Truncate(0);
    return false;
  }
  Renumber(level);
  kept_.Clear(rank_);
  SolveLast();
  return true;
}

void LexicographicFactorization::Merge(int level) {
  Truncate(level);
  Renumber(level);
  if (kept_.size() == 0) kept_.Clear(rank_);
  Count(2 * kept_.size() * (rank_ - kept_.rank()), variables_.num_free());
  for (int e = kept_.rank(); e < rank_; ++e) {
    kept_.Extend(q(e), variables_.num_free());
  }
}

// Gives all rows to the level before `level`.
void LexicographicFactorization::Renumber(int level) {
  num_merged_ = level;
  levels_.assign(level, {0, 0, 0, 0, false});
  if (level > 0) levels_.back() = {0, num_rows_, 0, rank_, false};
}

void LexicographicFactorization::RemoveRow(int a) {
  const int last = --num_rows_;
  int removed = 0;
  while (carrier_[removed] != a) ++removed;
  if (removed < variables_.size()) removed = Release(removed);
  const int columns = variables_.num_free();
  for (int e = removed; e + 1 < rank_; ++e) {
    // The next row of L moves up and has one entry too many. A rotation of its
    // last two columns, and of the two rows of Q, eliminates that entry.
    double* next = effective(e + 1);
    const double length = kernels::Length(next[e], next[e + 1]);
    const double c = next[e] / length, s = next[e + 1] / length;
    next[e] = length;
    for (int i = e + 2; i < rank_; ++i)
      kernels::RotatePair(c, s, effective(i) + e);
    std::copy_n(next, e + 1, effective(e));
    kernels::Rotate(c, s, columns, q(e), q(e + 1));
    kept_.Rotate(e, c, s);
    Count(4, columns + kept_.size());
    carrier_[e] = carrier_[e + 1];
  }
  kept_.RemoveLast(q(--rank_), columns);
  Count(kept_.size(), columns);
  for (int e = 0; e < rank_; ++e) {
    if (carrier_[e] == last) carrier_[e] = a;
  }
  target_[a] = target_[last];
  metric_[a] = metric_[last];
  levels_.back().end_row = num_rows_;
  levels_.back().rank_end = rank_;
}

// Makes the e-th fixed variable free. Its row, a unit vector, becomes the first
// of free_basis(). Returns the number of this row.
int LexicographicFactorization::Release(int e) {
  const int last = variables_.size() - 1;
  std::swap(carrier_[e], carrier_[last]);
  std::swap(effective(e)[e], effective(last)[last]);
  if (e != last) kept_.Swap(e, last);
  variables_.Release(e);
  const int column = variables_.num_free() - 1;
  std::fill_n(q(last), column, 0);
  q(last)[column] = 1;
  for (int i = last + 1; i < rank_; ++i) {
    std::swap(effective(i)[e], effective(i)[last]);
    q(i)[column] = 0;
  }
  kept_.SetZero(column);
  return last;
}

bool LexicographicFactorization::AppendRow() {
  const int a = num_rows_ - 1;
  if (rank_ == n_) {
    --num_rows_;
    return false;
  }
  ProjectRow(a);
  if (rest_[a] < tolerances::kReorthogonalize * tolerances::kReorthogonalize) {
    TakeOut(variables_.size(), rank_, row(a), l_row(a));
    rest_[a] = SquaredNorm(row(a), variables_.num_free());
  }
  const double norm = std::sqrt(rest_[a]);
  if (norm < tolerances::kIndependentPart) {
    --num_rows_;
    return false;
  }
  double* l = effective(rank_);
  std::copy_n(l_row(a), rank_, l);
  l[rank_] = norm;
  const int columns = variables_.num_free();
  kernels::Scale(row(a), 1 / norm, columns, q(rank_));
  kept_.Extend(q(rank_), columns);
  Count(2 * kept_.size(), columns);
  carrier_[rank_] = a;
  levels_.back().end_row = num_rows_;
  levels_.back().rank_end = ++rank_;
  return true;
}

bool LexicographicFactorization::AppendFixedVariable(int variable,
                                                     double entry) {
  const int a = num_rows_ - 1;
  if (variables_.is_fixed(variable)) {
    --num_rows_;
    return false;
  }
  std::fill_n(row(a), n_, 0);
  row(a)[variables_.column(variable)] = entry;
  if (!AppendRow()) return false;
  FixLast(variable, entry);
  return true;
}

// Moves the last row, entry * y_variable, before all rows that fix no variable.
// Rotations from the last column of L to the first make this row of L a unit
// vector. The row of Q that belongs to it is then entry * e_variable, and the
// other rows have rounding in this column.
void LexicographicFactorization::FixLast(int variable, double entry) {
  const int first = variables_.size(), last = rank_ - 1;
  const int columns = variables_.num_free();
  const int carrier = carrier_[last];
  double* l = scratch_.data();
  std::copy_n(effective(last), last + 1, l);
  for (int e = last; e > first; --e) {
    // Row e - 1 of L moves down.
    double* moved = effective(e);
    std::copy_n(effective(e - 1), e, moved);
    moved[e] = 0;
    carrier_[e] = carrier_[e - 1];
    const double length = kernels::Length(l[e - 1], l[e]);
    const double c = l[e - 1] / length, s = l[e] / length;
    l[e - 1] = length;
    for (int i = e; i <= last; ++i)
      kernels::RotatePair(c, s, effective(i) + e - 1);
    kernels::Rotate(c, s, columns, q(e - 1), q(e));
    kept_.Rotate(e - 1, c, s);
    Count(4, columns + kept_.size());
  }
  for (int e = first + 1; e <= last; ++e) effective(e)[first] *= entry;
  std::fill_n(effective(first), first, 0);
  effective(first)[first] = entry;
  carrier_[first] = carrier;
  if (entry < 0) kept_.Negate(first);
  const int column = variables_.Fix(variable);
  for (int e = first + 1; e <= last; ++e) q(e)[column] = q(e)[columns - 1];
  kept_.MoveColumn(columns - 1, column);
}

}  // namespace poise
