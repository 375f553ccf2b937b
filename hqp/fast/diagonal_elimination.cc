// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// DiagonalLevels: reflections of the rows of Q that eliminate variables, U' Q =
// T.
#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/diagonal_levels.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/math/rank.h"

namespace poise {
namespace {

using kernels::AddRows;
using kernels::AddToRows;
using kernels::SquaredNorm;

}  // namespace

void DiagonalLevels::Tie(const LexicographicFactorization& leading) {
  const FixedVariables& variables = leading.variables();
  Gather(leading.free_basis(), leading.stride(),
         leading.rank() - variables.size(), variables);
  EliminateAll(num_free_);
}

void DiagonalLevels::TieRows(const double* rows, int stride, int count) {
  Gather(rows, stride, count, none_);
  // The first level gets the remaining rows, so its columns are not needed.
  EliminateAll(blocks_[0].begin);
}

// Eliminates the levels from the last to the first, in the columns before
// `end`.
void DiagonalLevels::EliminateAll(int end) {
  int row = 0;
  for (int level = num_levels_ - 1; level >= 0; --level) {
    blocks_[level].row_begin = row;
    blocks_[level].row_end = level == 0 ? rank_ : row;
    if (level > 0) Eliminate(level, end);
    row = blocks_[level].row_end;
  }
}

void DiagonalLevels::Gather(const double* rows, int stride, int count,
                            const FixedVariables& variables) {
  Arrange(variables);
  rank_ = count;
  is_factored_ = false;
  for (int p = 0; p < num_free_; ++p) column_[p] = variables.column(order_[p]);
  for (int i = 0; i < rank_; ++i) {
    const double* from = rows + static_cast<size_t>(i) * stride;
    double* to = T(i);
    for (int p = 0; p < num_free_; ++p) to[p] = from[column_[p]];
  }
}

// Reflects the rows until as few rows as possible contain the level's
// variables.
void DiagonalLevels::Eliminate(int level, int end) {
  Block& block = blocks_[level];
  for (int steps = block.end - block.begin; steps > 0; --steps) {
    const int row = block.row_end;
    double squared = 0;
    const int pivot =
        LargestColumn(row, rank_, block.begin, block.end, &squared);
    if (squared <= kRankTolerance * kRankTolerance) return;
    Reflect(row, rank_, row, pivot, block.begin, end);
    pivot_[row] = pivot;
    ++block.row_end;
  }
}

// Reflects the first level's variables of unusual weight into its last rows.
// The rows before have variables of the usual weight only. They are orthonormal
// and orthogonal to the last rows, and stay so when divided by d. Where no row
// is left before, the last rows are still more independent when divided by d:
// without the reflections, a force would have one digit less.
void DiagonalLevels::Separate() {
  const Block& block = blocks_[0];
  usual_row_end_ = block.row_end;
  const int others = usual_begin_ - block.begin;
  if (2 * others > block.end - block.begin) usual_row_end_ = block.row_begin;
  for (int steps = others; steps > 0; --steps) {
    double squared = 0;
    const int pivot = LargestColumn(block.row_begin, usual_row_end_,
                                    block.begin, usual_begin_, &squared);
    if (squared <= tolerances::kZeroEntry * tolerances::kZeroEntry) return;
    Reflect(block.row_begin, usual_row_end_, usual_row_end_ - 1, pivot,
            block.begin, num_free_);
    --usual_row_end_;
  }
}

// Returns the column with the largest sum of squares over the given rows.
int DiagonalLevels::LargestColumn(int row_begin, int row_end, int begin,
                                  int end, double* squared) {
  if (row_begin >= row_end) return begin;
  double* squares = scratch_.data();
  kernels::ColumnSquares(T(row_begin) + begin, stride_, row_end - row_begin,
                         end - begin, squares);
  Count(row_end - row_begin, end - begin);
  const double* largest = std::max_element(squares, squares + end - begin);
  *squared = *largest;
  return begin + static_cast<int>(largest - squares);
}

// Reflects the given rows by H = I - v v', so that column `pivot` is zero
// except in row `target`. The rows are zero in the columns before `begin`.
void DiagonalLevels::Reflect(int row_begin, int row_end, int target, int pivot,
                             int begin, int end) {
  double* first = T(row_begin);
  double* v = reflection_.data();
  const int rows = row_end - row_begin;
  for (int i = 0; i < rows; ++i) {
    v[row_begin + i] = first[static_cast<size_t>(i) * stride_ + pivot];
  }
  const double squared = SquaredNorm(v + row_begin, rows);
  const double alpha = v[target] > 0 ? -std::sqrt(squared) : std::sqrt(squared);
  const double root = std::sqrt(squared - alpha * v[target]);
  v[target] -= alpha;
  for (int i = row_begin; i < row_end; ++i) {
    v[i] /= root;
    factor_[i] = -v[i];
  }
  const int columns = end - begin;
  std::fill_n(scratch_.data(), columns, 0);
  AddRows(first + begin, stride_, rows, v + row_begin, columns,
          scratch_.data());
  AddToRows(first + begin, stride_, rows, factor_.data() + row_begin,
            scratch_.data(), columns);
  Count(2 * rows, columns);
}

}  // namespace poise
