// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Of ActiveProblem, how y is improved by the rows as they were given.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hqp/fast/kernels.h"
#include "hqp/fast/working_set_problem.h"

namespace poise {
namespace {

// Where a row is missed by less than this, relative to what it is added up
// from, nothing is left to refine.
constexpr double kRefined = 1e-13;

// Each brings 15 digits back or so: numbers of 1e-6 from beside those of 1e90.
constexpr int kMaxPasses = 8;

// Rows of one level that cannot all be met: where weights differ by more than
// this, what light ones lack is not right after one correction.
constexpr double kUneven = 1e6;

// An entry of y below this, relative to Size(), before and after, may be what
// refinement leaves of a zero.
constexpr double kNothing = 1e-18;

// The same of an entry of a row that y misses.
constexpr double kNothingOfRow = 1e-14;

}  // namespace

double ActiveProblem::Size() const {
  double largest =
      std::max(tail_.largest_target(), kernels::Largest(y_.data(), n_));
  for (int a = 0; a < head_.num_rows(); ++a) {
    largest = std::max(largest, std::abs(rows_[a].bound) / rows_[a].norm);
  }
  return largest;
}

// By what the rows miss their targets, and what that is added up from. Returns
// the worst ratio of the two on levels where it should be zero.
double ActiveProblem::FindLack(const Hierarchy& hierarchy) {
  double worst = 0;
  for (int level = 0; level < num_head_; ++level) {
    for (int a = head_.first_row(level); a < head_.end_row(level); ++a) {
      const Row& row = rows_[a];
      double value, size;
      kernels::DotWithSize(Original(hierarchy, a), y_.data(), n_, &value,
                           &size);
      lack_[a] = (row.bound - value) / row.norm;
      size_[a] = (std::abs(row.bound) + size) / row.norm;
      worst = std::max(worst, Missed(a));
    }
  }
  return worst;
}

// The same of one row, as last found.
double ActiveProblem::Missed(int a) const {
  return head_.residual(a) == 0 && size_[a] > 0 ? std::abs(lack_[a]) / size_[a]
                                                : 0;
}

// The same by level, each as a whole, by what its rows weigh in its gradient.
double ActiveProblem::WorstMissedLevel() const {
  double worst = 0;
  for (int level = 0; level < num_head_; ++level) {
    double missed = 0, force = 0;
    for (int a = 0; a < head_.num_rows(); ++a) {
      if (rows_[a].level != level || head_.residual(a) != 0) continue;
      missed = std::max(missed, head_.weight(a) * std::abs(lack_[a]));
      force = std::max(force, head_.weight(a) * size_[a]);
    }
    if (missed > 0) worst = std::max(worst, missed / force);
  }
  return worst;
}

// Whether a level that cannot be met has rows of weights as unlike as that.
bool ActiveProblem::IsUneven() const {
  for (int level = 0; level < num_head_; ++level) {
    if (!head_.is_deficient(level)) continue;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int a = head_.first_row(level); a < head_.end_row(level); ++a) {
      least = std::min(least, head_.weight(a));
      most = std::max(most, head_.weight(a));
    }
    if (most > kUneven * least) return true;
  }
  return false;
}

void ActiveProblem::RefineOther(const Hierarchy& hierarchy,
                                const std::vector<double>& y) {
  y_ = y;
  Refine(hierarchy, false);
}

void ActiveProblem::TakeOther(const Hierarchy& hierarchy,
                              const std::vector<double>& y) {
  y_ = y;
  FindResiduals(hierarchy);
}

void ActiveProblem::Refine(const Hierarchy& hierarchy, bool to_minimum) {
  double largest = Size();
  // First all levels; then, as what the tail asks for may be large and its
  // rounding with it, the head alone.
  const int enough = IsUneven() ? 2 : 1;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const double worst = FindLack(hierarchy);
    if (pass >= enough && worst <= kRefined) break;
    head_.Correct(lack_.data(), change_.data());
    tail_.Correct(head_, change_.data(), to_minimum && pass == 0, y_.data());
  }
  largest = std::max(largest, Size());
  if (FindLack(hierarchy) > kRefined) {
    // Where zero was meant, rounding is left, unless it is what the tail asks for,
    // or levels are met worse without: by more than a last digit.
    const double missed = WorstMissedLevel();
    change_ = y_;
    for (int j = 0; j < n_; ++j) {
      if (std::abs(y_[j]) < kNothing * largest && !IsAskedFor(j)) y_[j] = 0;
    }
    FindLack(hierarchy);
    if (WorstMissedLevel() > 2 * missed) y_ = change_;
    FindLack(hierarchy);
    for (int a = 0; a < head_.num_rows(); ++a) {
      if (Missed(a) > kRefined) TakeZeros(hierarchy, Original(hierarchy, a));
    }
  }
  FindResiduals(hierarchy);
}

// Whether an entry of y is what the tail asks for.
bool ActiveProblem::IsAskedFor(int j) const {
  const double target = tail_.target(j);
  return std::abs(y_[j] - target) <= kRefined * std::abs(target);
}

bool ActiveProblem::TakeZeros(const Hierarchy& hierarchy, const double* row) {
  const double nothing = kNothingOfRow * Size();
  const auto may_be_zero = [&](int j) {
    return y_[j] != 0 && std::abs(y_[j]) <= nothing && !IsAskedFor(j);
  };
  bool any = false;
  for (int j = 0; j < n_; ++j) any |= row[j] != 0 && may_be_zero(j);
  if (!any) return false;
  FindLack(hierarchy);
  for (int a = 0; a < head_.num_rows(); ++a) nu_[a] = Missed(a);
  const auto is_worse = [&] {
    FindLack(hierarchy);
    for (int a = 0; a < head_.num_rows(); ++a) {
      if (Missed(a) > std::max(2 * nu_[a], kRefined)) return true;
    }
    return false;
  };
  change_ = y_;
  const auto take_all = [&](bool of_row) {
    for (int j = 0; j < n_; ++j) {
      if ((row[j] != 0 || !of_row) && may_be_zero(j)) y_[j] = 0;
    }
    if (!is_worse()) return true;
    y_ = change_;
    return false;
  };
  // All of the row together, as one may be there to make up for another; or all
  // of y, as other rows may have brought it there; or one by one.
  if (!take_all(true) && !take_all(false)) {
    for (int j = 0; j < n_; ++j) {
      if (row[j] == 0 || !may_be_zero(j)) continue;
      y_[j] = 0;
      if (is_worse()) y_[j] = change_[j];
    }
  }
  FindResiduals(hierarchy);
  return y_ != change_;
}

// Those of levels that are deficient: of y, or zero.
void ActiveProblem::FindResiduals(const Hierarchy& hierarchy) {
  FindLack(hierarchy);
  for (int level = 0; level < num_head_; ++level) {
    if (!head_.is_deficient(level)) continue;
    const int first = head_.first_row(level), end = head_.end_row(level);
    double size = 0;
    for (int a = first; a < end; ++a) {
      nu_[a - first] = -lack_[a];
      size = std::max(size, size_[a]);
    }
    head_.SetResiduals(level, nu_.data(), size);
  }
}

}  // namespace poise
