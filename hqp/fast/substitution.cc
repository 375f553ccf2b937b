// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// LexicographicFactorization, third part: solutions, residuals and multipliers
// by substitution with L, and products with Q.
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {

using kernels::AddRows;
using kernels::Dots;
using kernels::SquaredNorm;

void LexicographicFactorization::SolveLevel(const Level& level) {
  SolveRows(level, target_.data() + level.first_row, z_.data());
  FindResiduals(level);
  // Rounding of z is relative to the targets of all rows of the level.
  double size = 0;
  for (int a = level.first_row; a < level.end_row; ++a) {
    size = std::max(size, std::abs(target_[a]));
  }
  KeepUnattainableResiduals(size + norm_z(), level);
}

void LexicographicFactorization::FindResiduals(const Level& level) {
  const int first = level.first_row, rows = level.end_row - first;
  double* residual = residual_.data() + first;
  std::fill_n(residual, rows, 0);
  if (!level.deficient) return;
  if (IsDetermined(level)) {
    CombineColumns(z_.data(), rank_, packed_.data());
    Dots(row(first), stride_, rows, packed_.data(), n_, residual);
    Count(rows, n_);
  } else {
    Dots(l_row(first), stride_, rows, z_.data(), level.rank_end, residual);
  }
  for (int i = 0; i < rows; ++i) residual[i] -= target_[first + i];
}

// Solves the rows of a level for its entries of z. Those of the levels before
// are given, and `target` is by row of the level.
void LexicographicFactorization::SolveRows(const Level& level,
                                           const double* target, double* z) {
  if (!level.has_effective_rows()) return;
  const int first = level.first_row, rows = level.end_row - first;
  if (level.deficient) {
    // H D (t - L z), where z is known.
    double* right = factor_.data();
    Dots(l_row(first), stride_, rows, z, level.rank_begin, right);
    for (int i = 0; i < rows; ++i) {
      right[i] = metric_[first + i] * (target[i] - right[i]);
    }
    for (int e = level.rank_end - 1; e >= level.rank_begin; --e) {
      Reflect(e, rows, right);
    }
    target = right;
  }
  const int begin = level.deficient ? level.rank_begin : 0;
  CountTriangle(level, begin);
  for (int e = level.rank_begin; e < level.rank_end; ++e) {
    const double* l = effective(e);
    double value = 0;
    if (e >= variables_.size())
      Dots(l + begin, 0, 1, z + begin, e - begin, &value);
    z[e] = (target[carrier_[e] - first] - value) / l[e];
  }
}

void LexicographicFactorization::SetResiduals(int level, const double* residual,
                                              double size) {
  const Level& of = levels_[level];
  std::copy(residual, residual + of.end_row - of.first_row,
            residual_.data() + of.first_row);
  KeepUnattainableResiduals(size, of);
}

// Sets rounding of the residuals of a deficient level to zero. At the optimum,
// H d residual is zero except on dependent rows; other entries are rounding. So
// the small residuals of large-weight rows have as many digits as those of
// small-weight rows.
void LexicographicFactorization::KeepUnattainableResiduals(double size,
                                                           const Level& level) {
  if (!level.deficient) return;
  const int first = level.first_row, rows = level.end_row - first;
  double* residual = residual_.data() + first;
  const double* metric = metric_.data() + first;
  for (int i = 0; i < rows; ++i) {
    residual[i] *= metric[i];
    factor_[i] = tolerances::kZeroResidual * metric[i] * size;
  }
  for (int e = level.rank_end - 1; e >= level.rank_begin; --e) {
    Reflect(e, rows, residual);
    factor_[carrier_[e] - first] = std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < rows; ++i) {
    if (std::abs(residual[i]) <= factor_[i]) residual[i] = 0;
  }
  for (int e = level.rank_begin; e < level.rank_end; ++e) {
    Reflect(e, rows, residual);
  }
  double force = 0, largest = 0;
  for (int i = 0; i < rows; ++i) {
    largest = std::max(largest, std::abs(residual[i]));
    force = std::max(force, metric[i] * std::abs(residual[i]));
  }
  for (int i = 0; i < rows; ++i) {
    const bool is_zero =
        metric[i] * std::abs(residual[i]) <=
            tolerances::kZeroResidual * force ||
        std::abs(residual[i]) <= tolerances::kReflectionRounding * largest;
    residual[i] = is_zero ? 0 : residual[i] / metric[i];
  }
}

void LexicographicFactorization::Correct(const double* residual, int num_levels,
                                         double* change) {
  for (int k = 0; k < num_levels; ++k) {
    SolveRows(levels_[k], residual + levels_[k].first_row, change);
  }
}

// Counts the multiply-adds of a substitution with the effective rows of a
// level, from column `begin` on, and for a deficient level also those with its
// given rows.
void LexicographicFactorization::CountTriangle(const Level& level, int begin) {
  const int first = std::max(level.rank_begin, variables_.size());
  const int rank = std::max(level.rank_end - first, 0);
  Count(rank, (first + level.rank_end) / 2 - begin);
  if (level.deficient) Count(level.end_row - level.first_row, 2 * rank + begin);
}

// Applies the reflection of column e to a vector over the rows of its level.
void LexicographicFactorization::Reflect(int e, int rows, double* x) const {
  const double* v = reflection(e);
  double dot;
  Dots(v, 0, 1, x, rows, &dot);
  dot = -dot;
  AddRows(v, 0, 1, &dot, rows, x);
}

void LexicographicFactorization::Project(const double* y, int rank,
                                         double* on_basis) {
  for (int c = 0; c < n_; ++c) packed_[c] = y[variables_.variable(c)];
  ProjectColumns(packed_.data(), rank, on_basis);
}

// Project() for a vector by column.
void LexicographicFactorization::ProjectColumns(const double* y, int rank,
                                                double* on_basis) {
  const int fixed = std::min(rank, variables_.size());
  const int columns = variables_.num_free();
  for (int e = 0; e < fixed; ++e) on_basis[e] = y[variables_.fixed_column(e)];
  Dots(q(fixed), stride_, rank - fixed, y, columns, on_basis + fixed);
  Count(rank - fixed, columns);
}

void LexicographicFactorization::AddCombination(const double* z, int rank,
                                                double* y) {
  CombineColumns(z, rank, packed_.data());
  for (int c = 0; c < n_; ++c) y[variables_.variable(c)] += packed_[c];
}

// Computes Q' z by column, with the first `rank` rows of Q.
void LexicographicFactorization::CombineColumns(const double* z, int rank,
                                                double* y) {
  const int fixed = std::min(rank, variables_.size());
  const int columns = variables_.num_free();
  std::fill_n(y, n_, 0);
  for (int e = 0; e < fixed; ++e) y[variables_.fixed_column(e)] = z[e];
  AddRows(q(fixed), stride_, rank - fixed, z + fixed, columns, y);
  Count(rank - fixed, columns);
}

double LexicographicFactorization::norm_z() const {
  return std::sqrt(SquaredNorm(z_.data(), rank_));
}

double LexicographicFactorization::Gradient(int level, double* gradient) {
  const Level& of = levels_[level];
  // If the levels before determine y, the gradient is a sum of the rows
  // themselves.
  const bool is_determined = IsDetermined(of);
  double* sum = is_determined ? packed_.data() : gradient;
  std::fill_n(sum, of.rank_begin, 0);
  double size = 0, largest = 0;
  for (int a = of.first_row; a < of.end_row; ++a) {
    if (residual_[a] == 0) continue;
    const double factor = weight(a) * residual_[a];
    size = std::max(size, std::abs(factor));
    AddRows(is_determined ? row(a) : l_row(a), 0, 1, &factor, of.rank_begin,
            sum);
  }
  if (is_determined) ProjectColumns(sum, of.rank_begin, gradient);
  for (int e = 0; e < of.rank_begin; ++e) {
    largest = std::max(largest, std::abs(gradient[e]));
  }
  return largest > tolerances::kZeroResidual * size ? size : 0;
}

void LexicographicFactorization::SolveDual(int level, double* rhs, double* nu) {
  for (int above = level - 1; above >= 0; --above) {
    const Level& from = levels_[above];
    const int first = from.first_row, rows = from.end_row - first;
    const int begin = from.deficient ? from.rank_begin : 0;
    std::fill_n(nu + first, rows, 0);
    if (!from.has_effective_rows()) continue;
    CountTriangle(from, begin);
    for (int e = from.rank_end - 1; e >= from.rank_begin; --e) {
      const double* l = effective(e);
      const double value = rhs[e] / l[e], minus = -value;
      if (e >= variables_.size()) {
        AddRows(l + begin, 0, 1, &minus, e - begin, rhs + begin);
      }
      nu[carrier_[e]] = value;
    }
    if (!from.deficient) continue;
    // The reflections map the multipliers of effective rows back to the rows.
    for (int e = from.rank_begin; e < from.rank_end; ++e) {
      Reflect(e, rows, nu + first);
    }
    for (int i = 0; i < rows; ++i) {
      nu[first + i] *= metric_[first + i];
      factor_[i] = -nu[first + i];
    }
    AddRows(l_row(first), stride_, rows, factor_.data(), begin, rhs);
  }
}

}  // namespace poise
