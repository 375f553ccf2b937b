// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// DiagonalLevels: the minimum-norm problem of each level, T/d = L Q, and its
// multipliers.
#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/math/rank.h"

namespace poise {
namespace {

using kernels::AddRows;
using kernels::Dots;
using kernels::SquaredNorm;

}  // namespace

// Factors T/d = L Q by Gram-Schmidt.
void DiagonalLevels::FactorLevel(int level) {
  if (level == 0 && IsSquare()) return;
  const Block& block = blocks_[level];
  for (int row = block.row_begin; row < block.row_end; ++row) {
    FactorRow(level, row);
  }
}

// Factors a row of T/d. Returns the part of its length that is independent of
// the rows before it. A dependent row, which only rounding can cause, is set to
// zero.
double DiagonalLevels::FactorRow(int level, int row) {
  const Block& block = blocks_[level];
  const int columns = block.end - block.begin;
  const int i = row - block.row_begin;
  const int usual = level == 0 ? usual_row_end_ - block.row_begin : 0;
  const int from = usual > 0 && RoundsUsual() ? 0 : usual;
  double* first = Q(block.row_begin + from);
  double *q = Q(row), *l = L(row);
  const double* t = T(row) + block.begin;
  std::fill_n(l, i + 1, 0);
  if (i < usual) {
    const int others = usual_begin_ - block.begin;
    std::fill_n(q, others, 0);
    std::copy_n(t + others, columns - others, q + others);
    l[i] = 1 / scale_[usual_begin_];
    return 1;
  }
  kernels::MultiplyEntries(t, inverse_scale_.data() + block.begin,
                           tolerances::kZeroEntry, columns, q);
  const double before = SquaredNorm(q, columns);
  double after = before;
  const int above = i - from;
  for (int pass = 0; pass < 2 && above > 0; ++pass) {
    Dots(first, stride_, above, q, columns, scratch_.data());
    for (int k = 0; k < above; ++k) {
      l[from + k] += scratch_[k];
      scratch_[k] = -scratch_[k];
    }
    AddRows(first, stride_, above, scratch_.data(), columns, q);
    after = SquaredNorm(q, columns);
    Count(2 * above + 1, columns);
    if (after > before / 4) break;
  }
  if (after <= kRankTolerance * kRankTolerance * before) {
    std::fill_n(q, columns, 0);
    return 0;
  }
  l[i] = std::sqrt(after);
  kernels::Scale(q, 1 / l[i], columns, q);
  return std::sqrt(after / before);
}

// Returns whether rounding of the first level's large-weight variables disturbs
// those of the usual weight. The ratio of the weights multiplies that rounding.
bool DiagonalLevels::RoundsUsual() const {
  for (int p = blocks_[0].begin; p < usual_begin_; ++p) {
    const double ratio = scale_[p] / scale_[usual_begin_];
    if (ratio * ratio > tolerances::kLargeWeightRatio) return true;
  }
  return false;
}

// Minimises |x|^2, with x = d (step - ideal), subject to
// (T/d) x = -T ideal - (T of the earlier levels) (their step). If T is
// orthogonal, x/d is -T' T ideal.
void DiagonalLevels::SolveLevel(int level) {
  const Block& block = blocks_[level];
  const int columns = block.end - block.begin, rest = num_free_ - block.end;
  const int rows = block.row_end - block.row_begin;
  double* z = z_.data() + block.row_begin;
  double* x = x_.data() + block.begin;
  Dots(T(block.row_begin) + block.begin, stride_, rows,
       ideal_.data() + block.begin, columns, z);
  std::fill_n(x, columns, 0);
  if (level == 0 && IsSquare()) {
    for (int i = 0; i < rows; ++i) z[i] = -z[i];
    AddRows(T(block.row_begin) + block.begin, stride_, rows, z, columns, x);
    for (int p = block.begin; p < block.end; ++p) {
      step_[p] = ideal_[p] + x_[p];
      x_[p] *= scale_[p];
    }
    return;
  }
  Dots(T(block.row_begin) + block.end, stride_, rows, step_.data() + block.end,
       rest, scratch_.data());
  for (int i = 0; i < rows; ++i) {
    const double* l = L(block.row_begin + i);
    double value;
    Dots(l, 0, 1, z, i, &value);
    z[i] = l[i] == 0 ? 0 : (-z[i] - scratch_[i] - value) / l[i];
  }
  AddRows(Q(block.row_begin), stride_, rows, z, columns, x);
  for (int p = block.begin; p < block.end; ++p) {
    step_[p] = ideal_[p] + x_[p] * inverse_scale_[p];
  }
}

// Solves L' nu = -z. Rounding of a row's target appears in nu divided by the
// squared diagonal of L. So a row that small-weight variables can meet has a
// small threshold. If the rows leave no freedom, T' nu = -d x instead.
void DiagonalLevels::FindMultipliers(int level) {
  Block& block = blocks_[level];
  double squared = 0;
  for (int p = block.begin; p < block.end; ++p) {
    squared += magnitude_[p] * magnitude_[p];
  }
  double largest = 0;
  // Largest factor from rounding of y to rounding of a multiplier.
  double weight = 0;
  for (int p = num_free_; p < n_; ++p) {
    const int j = order_[p];
    if (level_of_[j] != level) continue;
    squared += magnitude_[p] * magnitude_[p];
    weight = std::max(weight, weight_[j]);
    largest = std::max(largest, std::abs(gradient_[p]));
  }
  const int rows = block.row_end - block.row_begin;
  double *z = z_.data() + block.row_begin, *nu = nu_.data() + block.row_begin;
  if (level == 0 && IsSquare()) {
    for (int p = block.begin; p < block.end; ++p) {
      scratch_[p - block.begin] = -scale_[p] * x_[p];
      weight = std::max(weight, weight_[order_[p]]);
    }
    Dots(T(block.row_begin) + block.begin, stride_, rows, scratch_.data(), rows,
         nu);
    Count(rows, rows);
  } else {
    for (int i = rows - 1; i >= 0; --i) {
      const double* l = L(block.row_begin + i);
      nu[i] = l[i] == 0 ? 0 : -z[i] / l[i];
      AddRows(l, 0, 1, &nu[i], i, z);
      if (l[i] > 0) weight = std::max(weight, 1 / (l[i] * l[i]));
    }
  }
  largest = std::max(largest, kernels::Largest(nu, rows));
  const double size = std::sqrt(squared) * weight;
  // The steps of earlier levels are in nu, but not in the threshold.
  block.size =
      largest > tolerances::kZeroGradient * size ? std::max(size, largest) : 0;
}

}  // namespace poise
