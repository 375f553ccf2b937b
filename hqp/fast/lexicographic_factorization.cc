// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/lexicographic_factorization.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/math/rank.h"

namespace poise {
namespace {

using kernels::AddRows;
using kernels::AddToRows;
using kernels::Dots;
using kernels::SquaredNorm;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

LexicographicFactorization::LexicographicFactorization(int num_variables,
                                                       int max_rows,
                                                       int max_levels,
                                                       int max_kept_rows)
    : n_(num_variables),
      stride_((num_variables + 7) / 4 * 4),
      kept_(num_variables, max_rows, max_kept_rows) {
  const auto rows = [&](int count) {
    return static_cast<size_t>(count) * stride_;
  };
  levels_.reserve(max_levels);
  work_.resize(rows(max_rows));
  l_.resize(rows(max_rows));
  q_.resize(rows(n_));
  effective_.resize(rows(n_));
  effective_target_.resize(n_);
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
  cosine_.resize(n_);
  sine_.resize(n_);
  chosen_.resize(max_rows);
  open_.resize(max_rows);
  nonzero_.resize(max_rows);
  reduced_target_.resize(max_rows);
  key_.resize(max_rows);
  is_recalled_.resize(max_rows);
}

void LexicographicFactorization::Truncate(int level) {
  levels_.resize(std::min<size_t>(levels_.size(), level));
  num_rows_ = levels_.empty() ? 0 : levels_.back().end_row;
  rank_ = levels_.empty() ? 0 : levels_.back().rank_end;
  if (level == 0 || rank_ < kept_.rank()) kept_.Clear(rank_);
}

int LexicographicFactorization::AddRow(double target, double metric) {
  target_[num_rows_] = target;
  metric_[num_rows_] = metric;
  key_[num_rows_] = kNoKey;
  return num_rows_++;
}

bool LexicographicFactorization::Recall(int a, int key) {
  key_[a] = key;
  is_recalled_[a] =
      kept_.Use(key, &l_[static_cast<size_t>(a) * stride_], row(a));
  return is_recalled_[a];
}

bool LexicographicFactorization::is_deficient(int level) const {
  return levels_[level].deficient;
}

bool LexicographicFactorization::is_well_conditioned() const {
  if (rank_ < num_rows_) return false;
  for (int e = 0; e < rank_; ++e) {
    if (effective_[static_cast<size_t>(e) * (stride_ + 1)] <
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
  for (int a = level.first_row; a < level.end_row; ++a) Project(a);
  PivotRows(&level);
  const int rows = level.end_row - level.first_row;
  level.deficient = level.rank_end - level.rank_begin < rows;
  rank_ = level.rank_end;
  if (level.deficient) {
    Reduce(&level);
  } else {
    for (int e = level.rank_begin; e < level.rank_end; ++e) {
      std::copy_n(&l_[static_cast<size_t>(carrier_[e]) * stride_], e + 1,
                  &effective_[static_cast<size_t>(e) * stride_]);
      effective_target_[e] = target_[carrier_[e]];
    }
  }
  SolveLevel(level);
  levels_.push_back(level);
}

void LexicographicFactorization::Merge(int level) {
  Truncate(level);
  Renumber(level);
  if (kept_.size() == 0) kept_.Clear(rank_);
  Count(2 * kept_.size() * (rank_ - kept_.rank()), n_);
  for (int e = kept_.rank(); e < rank_; ++e) {
    kept_.Extend(&q_[static_cast<size_t>(e) * stride_]);
  }
}

// Gives all rows to the level before `level`.
void LexicographicFactorization::Renumber(int level) {
  levels_.assign(level, {0, 0, 0, 0, false});
  if (level > 0) levels_.back() = {0, num_rows_, 0, rank_, false};
}

void LexicographicFactorization::RemoveRow(int a) {
  Level& level = levels_.back();
  const auto l = [&](int e) {
    return &effective_[static_cast<size_t>(e) * stride_];
  };
  const auto q = [&](int e) { return &q_[static_cast<size_t>(e) * stride_]; };
  const int last = --num_rows_;
  int removed = 0;
  while (carrier_[removed] != a) ++removed;
  for (int e = removed; e + 1 < rank_; ++e) {
    // The next row of L moves up and has one entry too many. A rotation of its
    // last two columns, and of the two rows of Q, eliminates that entry.
    double* row = l(e);
    std::copy_n(l(e + 1), e + 2, row);
    for (int k = removed; k < e; ++k) {
      const double x = row[k], y = row[k + 1];
      row[k] = cosine_[k] * x + sine_[k] * y;
      row[k + 1] = cosine_[k] * y - sine_[k] * x;
    }
    const double length = std::hypot(row[e], row[e + 1]);
    cosine_[e] = row[e] / length;
    sine_[e] = row[e + 1] / length;
    row[e] = length;
    kernels::Rotate(cosine_[e], sine_[e], n_, q(e), q(e + 1));
    kept_.Rotate(e, cosine_[e], sine_[e]);
    Count(4, n_ + kept_.size());
    carrier_[e] = carrier_[e + 1];
    effective_target_[e] = effective_target_[e + 1];
  }
  kept_.RemoveLast(q(--rank_));
  Count(kept_.size(), n_);
  for (int e = 0; e < rank_; ++e) {
    if (carrier_[e] == last) carrier_[e] = a;
  }
  target_[a] = target_[last];
  metric_[a] = metric_[last];
  level.end_row = num_rows_;
  level.rank_end = rank_;
}

bool LexicographicFactorization::AppendRow() {
  const int a = num_rows_ - 1;
  Project(a);
  if (rest_[a] < tolerances::kReorthogonalize * tolerances::kReorthogonalize) {
    TakeOut(0, rank_, row(a), &l_[static_cast<size_t>(a) * stride_]);
  }
  const double norm = std::sqrt(rest_[a]);
  if (rank_ == n_ || norm < tolerances::kIndependentPart) {
    --num_rows_;
    return false;
  }
  double* l = &effective_[static_cast<size_t>(rank_) * stride_];
  std::copy_n(&l_[static_cast<size_t>(a) * stride_], rank_, l);
  l[rank_] = norm;
  double* q = &q_[static_cast<size_t>(rank_) * stride_];
  for (int j = 0; j < n_; ++j) q[j] = row(a)[j] / norm;
  kept_.Extend(q);
  Count(2 * kept_.size(), n_);
  carrier_[rank_] = a;
  effective_target_[rank_] = target_[a];
  levels_.back().end_row = num_rows_;
  levels_.back().rank_end = ++rank_;
  return true;
}

// Projects row a once onto the complement of the levels before.
void LexicographicFactorization::Project(int a) {
  double* l = &l_[static_cast<size_t>(a) * stride_];
  if (key_[a] != kNoKey && !is_recalled_[a]) ProjectKept(a);
  const int begin = key_[a] == kNoKey ? 0 : kept_.rank();
  std::fill(l + begin, l + rank_, 0);
  TakeOut(begin, rank_, row(a), l);
  rest_[a] = SquaredNorm(row(a), n_);
}

// Projects row a onto the complement of the merged levels, and keeps that.
void LexicographicFactorization::ProjectKept(int a) {
  double* l = &l_[static_cast<size_t>(a) * stride_];
  std::fill_n(l, kept_.rank(), 0);
  TakeOut(0, kept_.rank(), row(a), l);
  if (SquaredNorm(row(a), n_) <
      tolerances::kReorthogonalize * tolerances::kReorthogonalize) {
    TakeOut(0, kept_.rank(), row(a), l);
  }
  (void)kept_.Add(key_[a], l, row(a));
}

// Subtracts the projection on the rows of Q from `begin` to `end` from x, and
// adds its coefficients to l.
void LexicographicFactorization::TakeOut(int begin, int end, double* x,
                                         double* l) {
  const double* q = &q_[static_cast<size_t>(begin) * stride_];
  Dots(q, stride_, end - begin, x, n_, scratch_.data());
  for (int e = begin; e < end; ++e) {
    l[e] += scratch_[e - begin];
    scratch_[e - begin] = -scratch_[e - begin];
  }
  AddRows(q, stride_, end - begin, scratch_.data(), n_, x);
  Count(2 * (end - begin), n_);
}

// Counts multiply-adds: one for each entry of `rows` rows.
void LexicographicFactorization::Count(int rows, int columns) {
  multiply_adds_ += static_cast<std::int64_t>(rows) * columns;
}

// Orthogonalises the remainders of the level's rows, the largest weighted one
// first, until each is zero. A row that depends on large-weight rows then
// depends on them exactly. Otherwise the rounding of its remainder, times an
// unattainable residual, could outweigh a small-weight row.
void LexicographicFactorization::PivotRows(Level* level) {
  int open = 0;  // Rows that are neither orthogonalised nor zero.
  for (int a = level->first_row; a < level->end_row; ++a) {
    open_[open++] = a;
    fresh_[a] = rest_[a];  // As last computed, not downdated.
  }
  while (level->rank_end < n_) {
    const int pivot = TakePivot(&open);
    if (pivot < 0) break;
    const int e = level->rank_end;
    double* q = &q_[static_cast<size_t>(e) * stride_];
    double* l = &l_[static_cast<size_t>(pivot) * stride_];
    std::copy_n(row(pivot), n_, q);
    if (rest_[pivot] <
        tolerances::kReorthogonalize * tolerances::kReorthogonalize) {
      // A kept remainder is orthogonal to the merged levels already, but its
      // rounding grows as the remainder gets smaller.
      const bool is_clean = key_[pivot] != kNoKey &&
                            rest_[pivot] >= tolerances::kCleanRemainder *
                                                tolerances::kCleanRemainder;
      TakeOut(is_clean ? kept_.rank() : 0, e, q, l);
    }
    const double norm = std::sqrt(SquaredNorm(q, n_));
    l[e] = 0;
    if (norm <= kRankTolerance) {
      // The remainder was rounding of other rows. The row is dependent.
      rest_[pivot] = 0;
      continue;
    }
    l[e] = norm;
    for (int i = 0; i < n_; ++i) q[i] /= norm;
    carrier_[e] = pivot;
    ++level->rank_end;
    // Update the other rows: coefficient, remainder, and squared norm.
    for (int a = level->first_row; a < level->end_row; ++a) {
      if (a != pivot) l_[static_cast<size_t>(a) * stride_ + e] = 0;
    }
    Dots(row(0), stride_, open_.data(), open, q, n_, factor_.data());
    for (int i = 0; i < open; ++i) {
      const int a = open_[i];
      l_[static_cast<size_t>(a) * stride_ + e] = factor_[i];
      rest_[a] -= factor_[i] * factor_[i];
      factor_[i] = -factor_[i];
    }
    AddToRows(row(0), stride_, open_.data(), open, factor_.data(), q, n_);
    Count(2 * open + 1, n_);
    for (int i = 0; i < open; ++i) {
      const int a = open_[i];
      // The difference of squares has lost its digits: compute the norm again.
      if (rest_[a] < tolerances::kDowndate * fresh_[a]) {
        rest_[a] = SquaredNorm(row(a), n_);
        fresh_[a] = rest_[a];
      }
    }
  }
}

// Removes the row with the largest weighted remainder, and rows whose remainder
// is zero, from the first `open` of open_. Returns this row, or -1 if all are zero.
int LexicographicFactorization::TakePivot(int* open) {
  int pivot = -1, left = 0;
  for (int i = 0; i < *open; ++i) {
    const int a = open_[i];
    if (rest_[a] <= kRankTolerance * kRankTolerance) continue;
    open_[left++] = a;
    if (pivot < 0 || weight(a) * rest_[a] > weight(pivot) * rest_[pivot]) {
      pivot = a;
    }
  }
  *open = static_cast<int>(
      std::remove(open_.begin(), open_.begin() + left, pivot) - open_.begin());
  return pivot;
}

// Reduces the rows d_a l_a, d_a t_a of a deficient level by reflections H, from
// the last column to the first. The result is lower triangular:
//     H [D L, D t] = [effective rows; zeros, residual].
// These rows replace the remainders, which are not needed any more.
void LexicographicFactorization::Reduce(Level* level) {
  const int first = level->first_row, rows = level->end_row - first;
  const int begin = level->rank_begin, end = level->rank_end;
  for (int i = 0; i < rows; ++i) {
    const int a = first + i;
    double* to = row(a);
    for (int e = 0; e < end; ++e) {
      to[e] = metric_[a] * l_[static_cast<size_t>(a) * stride_ + e];
    }
    reduced_target_[i] = metric_[a] * target_[a];
    chosen_[a] = false;
  }
  for (int e = end - 1; e >= begin; --e) {
    // The reflection moves column e of the rows not yet chosen into the row
    // where its entry is largest. Most entries are zero: those of all rows that
    // were orthogonalised before row e. Later columns are zero in these rows.
    double* v =
        &reflection_[static_cast<size_t>(e) * (reflection_.size() / n_)];
    int pivot = -1, count = 0;
    double squares = 0;
    for (int i = 0; i < rows; ++i) {
      v[i] = 0;
      if (chosen_[first + i]) continue;
      v[i] = row(first + i)[e];
      squares += v[i] * v[i];
      if (v[i] != 0) nonzero_[count++] = i;
      if (pivot < 0 || std::abs(v[i]) > std::abs(v[pivot])) pivot = i;
    }
    const double alpha =
        v[pivot] > 0 ? -std::sqrt(squares) : std::sqrt(squares);
    const double length = squares - alpha * v[pivot];  // v'v / 2 below.
    v[pivot] -= alpha;
    if (length > 0) {
      const double root = std::sqrt(length);  // So that H = I - v v'.
      double target = 0;
      for (int k = 0; k < count; ++k) {
        const int i = nonzero_[k];
        v[i] /= root;
        factor_[k] = v[i];
        target += v[i] * reduced_target_[i];
      }
      std::fill_n(scratch_.data(), e + 1, 0);
      AddRows(row(first), stride_, nonzero_.data(), count, factor_.data(),
              e + 1, scratch_.data());
      for (int k = 0; k < count; ++k) {
        factor_[k] = -factor_[k];
        reduced_target_[nonzero_[k]] += factor_[k] * target;
      }
      AddToRows(row(first), stride_, nonzero_.data(), count, factor_.data(),
                scratch_.data(), e + 1);
      Count(2 * count, e + 1);
    }
    chosen_[first + pivot] = true;
    carrier_[e] = first + pivot;
    const double* from = row(first + pivot);
    std::copy_n(from, e + 1, &effective_[static_cast<size_t>(e) * stride_]);
    effective_target_[e] = reduced_target_[pivot];
  }
}

void LexicographicFactorization::SolveLevel(const Level& level) {
  for (int e = level.rank_begin; e < level.rank_end; ++e) {
    const double* l = &effective_[static_cast<size_t>(e) * stride_];
    double value;
    Dots(l, 0, 1, z_.data(), e, &value);
    z_[e] = (effective_target_[e] - value) / l[e];
  }
  // Rounding of z is relative to the targets of all rows of the level.
  double size = 0;
  for (int a = level.first_row; a < level.end_row; ++a) {
    size = std::max(size, std::abs(target_[a]));
  }
  size += norm_z();
  for (int a = level.first_row; a < level.end_row; ++a) {
    residual_[a] = 0;
    if (!level.deficient) continue;
    double value;
    Dots(&l_[static_cast<size_t>(a) * stride_], 0, 1, z_.data(), level.rank_end,
         &value);
    residual_[a] = value - target_[a];
  }
  KeepUnattainableResiduals(size, level);
}

void LexicographicFactorization::SetResiduals(int level, const double* residual,
                                              double size) {
  const Level& of = levels_[level];
  std::copy(residual, residual + of.end_row - of.first_row,
            &residual_[of.first_row]);
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
  double* residual = &residual_[first];
  const double* metric = &metric_[first];
  for (int i = 0; i < rows; ++i) {
    residual[i] *= metric[i];
    factor_[i] = tolerances::kZeroResidual * metric[i] * size;
  }
  for (int e = level.rank_end - 1; e >= level.rank_begin; --e) {
    Reflect(e, rows, residual);
    factor_[carrier_[e] - first] = kInfinity;
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

void LexicographicFactorization::Correct(const double* residual,
                                         double* change) {
  for (const Level& level : levels_) {
    const int first = level.first_row, rows = level.end_row - first;
    double* right = scratch_.data();
    std::copy_n(residual + first, rows, right);
    if (level.deficient) {
      for (int i = 0; i < rows; ++i) right[i] *= metric_[first + i];
      for (int e = level.rank_end - 1; e >= level.rank_begin; --e) {
        Reflect(e, rows, right);
      }
    }
    for (int e = level.rank_begin; e < level.rank_end; ++e) {
      const double* l = &effective_[static_cast<size_t>(e) * stride_];
      double value;
      Dots(l, 0, 1, change, e, &value);
      change[e] = (right[carrier_[e] - first] - value) / l[e];
    }
  }
}

// Applies the reflection of column e to a vector over the rows of its level.
void LexicographicFactorization::Reflect(int e, int rows, double* x) const {
  const double* v =
      &reflection_[static_cast<size_t>(e) * (reflection_.size() / n_)];
  double dot;
  Dots(v, 0, 1, x, rows, &dot);
  dot = -dot;
  AddRows(v, 0, 1, &dot, rows, x);
}

double LexicographicFactorization::norm_z() const {
  return std::sqrt(SquaredNorm(z_.data(), rank_));
}

double LexicographicFactorization::Gradient(int level, double* gradient) const {
  const Level& of = levels_[level];
  std::fill_n(gradient, of.rank_begin, 0);
  double size = 0, largest = 0;
  for (int a = of.first_row; a < of.end_row; ++a) {
    if (residual_[a] == 0) continue;
    const double factor = weight(a) * residual_[a];
    size = std::max(size, std::abs(factor));
    AddRows(&l_[static_cast<std::size_t>(a) * stride_], 0, 1, &factor,
            of.rank_begin, gradient);
  }
  for (int e = 0; e < of.rank_begin; ++e) {
    largest = std::max(largest, std::abs(gradient[e]));
  }
  return largest > tolerances::kZeroResidual * size ? size : 0;
}

void LexicographicFactorization::SolveDual(int level, double* rhs, double* nu) {
  for (int above = level - 1; above >= 0; --above) {
    const Level& from = levels_[above];
    const int rows = from.end_row - from.first_row;
    std::fill_n(nu + from.first_row, rows, 0);
    for (int e = from.rank_end - 1; e >= from.rank_begin; --e) {
      const double* l = &effective_[static_cast<size_t>(e) * stride_];
      const double value = rhs[e] / l[e], minus = -value;
      AddRows(l, 0, 1, &minus, e, rhs);
      nu[carrier_[e]] = value;
    }
    if (!from.deficient) continue;
    // The reflections map the multipliers of effective rows back to the rows.
    for (int e = from.rank_begin; e < from.rank_end; ++e) {
      Reflect(e, rows, nu + from.first_row);
    }
    for (int a = from.first_row; a < from.end_row; ++a) nu[a] *= metric_[a];
  }
}

}  // namespace poise
