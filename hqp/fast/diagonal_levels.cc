// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/diagonal_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

using kernels::AddRows;
using kernels::Dots;

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
  // Factors from 1 to 2. No two are equal, so that two rows that are exchanged
  // change a sum of rows.
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

// Gives the free variables their positions, level by level from the last, and
// then the fixed ones.
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

// Returns the weight that more than half of the first level's free variables
// have, by a majority vote. If no weight has a majority, it returns one of the
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

// Counts multiply-adds: one for each entry of `rows` rows, and kRowOverhead a
// row.
void DiagonalLevels::Count(int rows, int columns) {
  multiply_adds_ +=
      static_cast<std::int64_t>(rows) * (columns + kernels::kRowOverhead);
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
