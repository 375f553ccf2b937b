// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/diagonal_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

DiagonalLevels::DiagonalLevels(int num_variables, int max_levels)
    : n_(num_variables),
      stride_((num_variables + 3) / 4 * 4),
      none_(num_variables) {
  const size_t square = static_cast<size_t>(n_) * stride_;
  level_of_.resize(n_);
  order_.resize(n_);
  pivot_.resize(n_);
  column_.resize(n_);
  blocks_.resize(max_levels + 1);
  group_begin_.resize(2 * blocks_.size() + 1);
  t_.resize(square);
  q_.resize(square);
  l_.resize(static_cast<size_t>(n_) * (n_ + 1) / 2);
  for (AlignedDoubles* vector :
       {&weight_, &target_, &root_, &start_, &step_, &ideal_, &scale_,
        &inverse_scale_, &x_, &magnitude_, &gradient_, &z_, &nu_, &scratch_,
        &factor_, &reflection_, &direction_, &probe_}) {
    vector->resize(stride_);
  }
  // Factors from 1 to 2. No two are equal, so that two rows that are exchanged change a
  // sum of rows.
  constexpr double kGoldenRatio = 1.618033988749895;
  for (int i = 0; i < n_; ++i) probe_[i] = 1 + std::fmod(i * kGoldenRatio, 1);
  Clear();
}

void DiagonalLevels::Clear() {
  num_levels_ = 0;
  is_factored_ = false;
  std::fill(level_of_.begin(), level_of_.end(), -1);
}

void DiagonalLevels::Add(int variable, double weight, double target) {
  int& level = level_of_[variable];
  if (weight == 0 || (level >= 0 && level != num_levels_ - 1)) return;
  if (level < 0) {
    level = num_levels_ - 1;
    weight_[variable] = weight;
    target_[variable] = target;
    return;
  }
  // Two rows of one level have their minimum at the weighted mean.
  const double sum = weight_[variable] + weight;
  target_[variable] =
      (weight_[variable] * target_[variable] + weight * target) / sum;
  weight_[variable] = sum;
}

void DiagonalLevels::Finish(const double* targets) {
  AddLevel();
  for (int j = 0; j < n_; ++j) {
    if (level_of_[j] < 0) Add(j, 1, targets != nullptr ? targets[j] : 0);
  }
  largest_target_ = 0;
  for (int j = 0; j < n_; ++j) {
    root_[j] = std::sqrt(weight_[j]);
    largest_target_ = std::max(largest_target_, std::abs(target_[j]));
  }
}

// Gives the free variables their positions, level by level from the last, and then
// the fixed ones.
void DiagonalLevels::Arrange(const FixedVariables& variables) {
  const double usual = UsualWeight(variables);
  // Each level has two groups: the variables of unusual weight come first.
  const auto group = [&](int level) { return 2 * (num_levels_ - 1 - level); };
  const auto group_of = [&](int j) {
    return group(level_of_[j]) + (weight_[j] == usual ? 1 : 0);
  };
  std::fill(group_begin_.begin(), group_begin_.end(), 0);
  for (int j = 0; j < n_; ++j) {
    if (!variables.is_fixed(j)) ++group_begin_[group_of(j) + 1];
  }
  std::partial_sum(group_begin_.begin(), group_begin_.end(),
                   group_begin_.begin());
  for (int level = 0; level < num_levels_; ++level) {
    blocks_[level].begin = group_begin_[group(level)];
    blocks_[level].end = group_begin_[group(level) + 2];
  }
  usual_begin_ = group_begin_[group(0) + 1];
  num_free_ = blocks_[0].end;
  for (int j = 0; j < n_; ++j) {
    if (!variables.is_fixed(j)) order_[group_begin_[group_of(j)]++] = j;
  }
  for (int e = 0; e < variables.size(); ++e) {
    order_[num_free_ + e] = variables.fixed_variable(e);
  }
  for (int p = 0; p < n_; ++p) SetScale(p);
}

// Returns the weight that more than half of the first level's free variables have,
// by a majority vote. If no weight has a majority, it returns one of the
// weights.
double DiagonalLevels::UsualWeight(const FixedVariables& variables) const {
  double weight = 0;
  int lead = 0;
  for (int j = 0; j < n_; ++j) {
    if (level_of_[j] != 0 || variables.is_fixed(j)) continue;
    if (lead == 0) weight = weight_[j];
    lead += weight_[j] == weight ? 1 : -1;
  }
  return weight;
}

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

void DiagonalLevels::Solve(const LexicographicFactorization& leading,
                           double* y) {
  if (!is_factored_ || !UpdateFactors(leading)) Factor(leading);
  Start(leading, leading.z());
  for (int p = 0; p < num_free_; ++p) {
    const double target = target_[order_[p]];
    ideal_[p] = target - start_[p];
    magnitude_[p] = std::abs(start_[p]) + std::abs(target);
  }
  for (int p = num_free_; p < n_; ++p) {
    y[order_[p]] = start_[p];
    FindGradient(p, y);
  }
  for (int level = 0; level < num_levels_; ++level) {
    SolveLevel(level);
    FindMultipliers(level);
  }
  for (int p = 0; p < num_free_; ++p) y[order_[p]] = start_[p] + step_[p];
}

void DiagonalLevels::Factor(const LexicographicFactorization& leading) {
  Tie(leading);
  if (!IsSquare()) Separate();
  for (int level = 0; level < num_levels_; ++level) FactorLevel(level);
  is_factored_ = true;
}

void DiagonalLevels::Correct(const LexicographicFactorization& leading,
                             const double* change, bool to_minimum, double* y) {
  Start(leading, change);
  for (int p = 0; p < num_free_; ++p) {
    const int j = order_[p];
    ideal_[p] = (to_minimum ? target_[j] - y[j] : 0) - start_[p];
    magnitude_[p] = std::abs(y[j]) + std::abs(target_[j]);
  }
  for (int p = num_free_; p < n_; ++p) {
    y[order_[p]] += start_[p];
    if (to_minimum) FindGradient(p, y);
  }
  for (int level = 0; level < num_levels_; ++level) {
    SolveLevel(level);
    if (to_minimum) FindMultipliers(level);
  }
  for (int p = 0; p < num_free_; ++p) y[order_[p]] += start_[p] + step_[p];
}

// Computes the entry of a fixed variable in the gradient of its level.
void DiagonalLevels::FindGradient(int position, const double* y) {
  const int j = order_[position];
  gradient_[position] = weight_[j] * (y[j] - target_[j]);
  magnitude_[position] = std::abs(y[j]) + std::abs(target_[j]);
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

// Computes start = Q' z, by position.
void DiagonalLevels::Start(const LexicographicFactorization& leading,
                           const double* z) {
  const FixedVariables& variables = leading.variables();
  const int fixed = variables.size(), free = variables.num_free();
  std::fill_n(scratch_.begin(), free, 0);
  AddRows(leading.free_basis(), leading.stride(), leading.rank() - fixed,
          z + fixed, free, scratch_.data());
  for (int p = 0; p < n_; ++p) {
    const int column = variables.column(order_[p]);
    start_[p] = column < free ? scratch_[column] : z[n_ - 1 - column];
  }
}

// Computes Q x, for x by position.
void DiagonalLevels::Project(const LexicographicFactorization& leading,
                             const double* x, double* on_leading) {
  const FixedVariables& variables = leading.variables();
  const int fixed = variables.size(), free = variables.num_free();
  for (int p = 0; p < n_; ++p) {
    const int column = variables.column(order_[p]);
    (column < free ? scratch_[column] : on_leading[n_ - 1 - column]) = x[p];
  }
  Dots(leading.free_basis(), leading.stride(), leading.rank() - fixed,
       scratch_.data(), free, on_leading + fixed);
  Count(leading.rank() - fixed, free);
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

// Returns whether rounding of the first level's large-weight variables disturbs
// those of the usual weight. The ratio of the weights multiplies that rounding.
bool DiagonalLevels::RoundsUsual() const {
  for (int p = blocks_[0].begin; p < usual_begin_; ++p) {
    const double ratio = scale_[p] / scale_[usual_begin_];
    if (ratio * ratio > tolerances::kLargeWeightRatio) return true;
  }
  return false;
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

// Counts multiply-adds: one for each entry of `rows` rows, and kRowOverhead a row.
void DiagonalLevels::Count(int rows, int columns) {
  multiply_adds_ +=
      static_cast<std::int64_t>(rows) * (columns + kernels::kRowOverhead);
}

// Factors T/d = L Q by Gram-Schmidt.
void DiagonalLevels::FactorLevel(int level) {
  if (level == 0 && IsSquare()) return;
  const Block& block = blocks_[level];
  for (int row = block.row_begin; row < block.row_end; ++row) {
    FactorRow(level, row);
  }
}

// Factors a row of T/d. Returns the part of its length that is independent of the
// rows before it. A dependent row, which only rounding can cause, is set to zero.
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

// Minimises |x|^2, with x = d (step - ideal), subject to
// (T/d) x = -T ideal - (T of the earlier levels) (their step). If T is orthogonal, x/d
// is -T' T ideal.
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

double DiagonalLevels::Dual(const LexicographicFactorization& leading,
                            int level, double* on_leading, double* left) {
  const Block& block = blocks_[level];
  if (block.size == 0) return 0;
  const int rows = block.row_end - block.row_begin;
  // T' nu, and the gradient on fixed variables.
  double* sum = direction_.data();
  std::fill_n(sum, n_, 0);
  AddRows(T(block.row_begin) + block.begin, stride_, rows,
          nu_.data() + block.row_begin, num_free_ - block.begin,
          sum + block.begin);
  for (int p = num_free_; p < n_; ++p) {
    if (level_of_[order_[p]] == level) sum[p] = -gradient_[p];
  }
  for (int p = block.end; p < n_; ++p) {
    if (level_of_[order_[p]] < level) left[order_[p]] = sum[p];
  }
  Project(leading, sum, on_leading);
  return block.size;
}

bool DiagonalLevels::IsMet(int level, const double* y) const {
  for (int j = 0; j < n_; ++j) {
    if (level_of_[j] == level && y[j] != target_[j]) return false;
  }
  return true;
}

void DiagonalLevels::AddGradient(int level, const double* y, const double* left,
                                 double* sum) const {
  for (int j = 0; j < n_; ++j) {
    if (level_of_[j] == level) {
      sum[j] += weight_[j] * (y[j] - target_[j]);
    } else if (level_of_[j] < level) {
      sum[j] -= left[j];
    }
  }
}

void DiagonalLevels::ZeroRounding(int level, const double* y,
                                  double* sum) const {
  for (int j = 0; j < n_; ++j) {
    if (level_of_[j] != level) continue;
    const double size = weight_[j] * (std::abs(y[j]) + std::abs(target_[j]));
    if (std::abs(sum[j]) <= tolerances::kZeroGradient * size) sum[j] = 0;
  }
}

int DiagonalLevels::Nullity(int level) const {
  // The variables of later levels, minus the rows that determine them.
  int nullity = 0;
  for (int later = level + 1; later < num_levels_; ++later) {
    const Block& block = blocks_[later];
    nullity += block.end - block.begin - (block.row_end - block.row_begin);
  }
  return nullity;
}

}  // namespace poise
