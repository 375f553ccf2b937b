// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// WorkingSetProblem, second part: iterative refinement of y with the rows as
// given.
#include <algorithm>
#include <cmath>
#include <limits>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/hqp/fast/working_set_problem.h"

namespace poise {
namespace {

// Each pass recovers about 15 digits. So entries of y of 1e-6 are exact even if
// other entries are 1e90.
constexpr int kMaxPasses = 8;

}  // namespace

double WorkingSetProblem::Size() const {
  double largest =
      std::max(diagonal_.largest_target(), kernels::Largest(y_.data(), n_));
  for (int a = 0; a < leading_.num_rows(); ++a) {
    largest = std::max(largest, std::abs(rows_[a].bound) / rows_[a].norm);
  }
  return largest;
}

// Computes the residuals of the rows, and the magnitude of their terms. Returns
// the largest ratio of the two among rows whose residual should be zero.
double WorkingSetProblem::ComputeRowResiduals(const Hierarchy& hierarchy) {
  double worst = 0;
  for (int a = 0; a < leading_.num_rows(); ++a) {
    const Row& row = rows_[a];
    double value, size;
    const int first = row.span.first;
    kernels::DotWithSize(Original(hierarchy, row) + first, y_.data() + first,
                         row.span.size, &value, &size);
    row_residual_[a] = (row.bound - value) / row.norm;
    size_[a] = (std::abs(row.bound) + size) / row.norm;
    worst = std::max(worst, RelativeResidual(a));
  }
  return worst;
}

// Returns the ratio for one row, from the last ComputeRowResiduals(). The ratio
// is zero for rows that need not be met.
double WorkingSetProblem::RelativeResidual(int a) const {
  return leading_.residual(a) == 0 && size_[a] > 0
             ? std::abs(row_residual_[a]) / size_[a]
             : 0;
}

// Returns the largest ratio of the levels. For each level, the residuals and
// the magnitudes of their terms are multiplied by the weights of the rows in
// the gradient.
double WorkingSetProblem::WorstRelativeLevelResidual() const {
  double worst = 0;
  for (int level = 0; level < num_leading_; ++level) {
    double missed = 0, force = 0;
    for (int a = 0; a < leading_.num_rows(); ++a) {
      if (rows_[a].level != level || leading_.residual(a) != 0) continue;
      missed =
          std::max(missed, leading_.weight(a) * std::abs(row_residual_[a]));
      force = std::max(force, leading_.weight(a) * size_[a]);
    }
    if (missed > 0) worst = std::max(worst, missed / force);
  }
  return worst;
}

// Returns whether the weights of a deficient level differ by more than
// kUnevenWeights.
bool WorkingSetProblem::IsUneven() const {
  for (int level = 0; level < num_leading_; ++level) {
    if (!leading_.is_deficient(level)) continue;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int a = leading_.first_row(level); a < leading_.end_row(level); ++a) {
      least = std::min(least, leading_.weight(a));
      most = std::max(most, leading_.weight(a));
    }
    if (most > tolerances::kUnevenWeights * least) return true;
  }
  return false;
}

void WorkingSetProblem::RefineFrom(const Hierarchy& hierarchy,
                                   const std::vector<double>& y) {
  y_ = y;
  Refine(hierarchy, false);
}

void WorkingSetProblem::SetSolution(const Hierarchy& hierarchy,
                                    const std::vector<double>& y) {
  y_ = y;
  UpdateDeficientResiduals(hierarchy);
}

void WorkingSetProblem::Refine(const Hierarchy& hierarchy, bool to_minimum) {
  double largest = Size();
  // The first pass corrects all levels. Later passes correct the leading levels
  // only: targets of the diagonal levels may be large, and so may their
  // rounding.
  const int enough = IsUneven() ? 2 : 1;
  double worst = ComputeRowResiduals(hierarchy);
  bool is_met = false;
  for (int pass = 0; pass < kMaxPasses && !is_met; ++pass) {
    const double before = worst;
    leading_.Correct(row_residual_.data(), change_.data());
    diagonal_.Correct(leading_, change_.data(), to_minimum && pass == 0,
                      y_.data());
    worst = ComputeRowResiduals(hierarchy);
    if (pass + 1 < enough) continue;
    // A pass that converges recovers about 15 digits, so a half is no progress.
    is_met =
        worst <= tolerances::kRefined ||
        (worst > before / 2 && TryZeros(hierarchy, std::max(largest, Size())));
  }
  largest = std::max(largest, Size());
  if (!is_met) {
    // Rows that are still not met have rounding where y should be zero. Such
    // entries are set to zero, except those at the target of a diagonal level.
    // All are restored if this more than doubles the residual of a level.
    const double missed = WorstRelativeLevelResidual();
    change_ = y_;
    (void)ZeroNegligibleEntries(largest);
    ComputeRowResiduals(hierarchy);
    if (WorstRelativeLevelResidual() > 2 * missed) y_ = change_;
    ComputeRowResiduals(hierarchy);
    for (int a = 0; a < leading_.num_rows(); ++a) {
      if (RelativeResidual(a) > tolerances::kRefined)
        ZeroRoundingEntries(hierarchy, Original(hierarchy, rows_[a]));
    }
  }
  TakeDeficientResiduals();
}

// Sets the entries of y to zero that are negligible beside `largest`, except
// those at the target of a diagonal level. Returns whether there was one.
bool WorkingSetProblem::ZeroNegligibleEntries(double largest) {
  bool any = false;
  for (int j = 0; j < n_; ++j) {
    if (y_[j] != 0 &&
        std::abs(y_[j]) < tolerances::kNegligibleEntry * largest &&
        !IsAtTarget(j)) {
      y_[j] = 0;
      any = true;
    }
  }
  return any;
}

// Sets negligible entries of y to zero if all rows are then met to rounding,
// and returns whether they are. If not, y is as before. The rows of a foot
// without load have the target zero. In each pass, rounding of other entries
// leaves a tiny value, so that these rows are never met relative to their own
// terms.
bool WorkingSetProblem::TryZeros(const Hierarchy& hierarchy, double largest) {
  change_ = y_;
  if (!ZeroNegligibleEntries(largest)) return false;
  if (ComputeRowResiduals(hierarchy) <= tolerances::kRefined) return true;
  y_ = change_;
  ComputeRowResiduals(hierarchy);
  return false;
}

// Returns whether an entry of y is at the target of its diagonal level.
bool WorkingSetProblem::IsAtTarget(int j) const {
  const double target = diagonal_.target(j);
  return std::abs(y_[j] - target) <= tolerances::kRefined * std::abs(target);
}

bool WorkingSetProblem::ZeroRoundingEntries(const Hierarchy& hierarchy,
                                            const double* row) {
  const double nothing = tolerances::kNegligibleEntryOfRow * Size();
  const auto may_be_zero = [&](int j) {
    return y_[j] != 0 && std::abs(y_[j]) <= nothing && !IsAtTarget(j);
  };
  bool any = false;
  for (int j = 0; j < n_; ++j) any |= row[j] != 0 && may_be_zero(j);
  if (!any) return false;
  ComputeRowResiduals(hierarchy);
  for (int a = 0; a < leading_.num_rows(); ++a) nu_[a] = RelativeResidual(a);
  const auto is_worse = [&] {
    ComputeRowResiduals(hierarchy);
    for (int a = 0; a < leading_.num_rows(); ++a) {
      if (RelativeResidual(a) > std::max(2 * nu_[a], tolerances::kRefined))
        return true;
    }
    return false;
  };
  change_ = y_;
  const auto zero_all = [&](bool of_row) {
    for (int j = 0; j < n_; ++j) {
      if ((row[j] != 0 || !of_row) && may_be_zero(j)) y_[j] = 0;
    }
    if (!is_worse()) return true;
    y_ = change_;
    return false;
  };
  // First all entries of the row are set to zero together, as one may
  // compensate another. Then all entries of y, as they may stem from other
  // rows. Then one by one.
  if (!zero_all(true) && !zero_all(false)) {
    for (int j = 0; j < n_; ++j) {
      if (row[j] == 0 || !may_be_zero(j)) continue;
      y_[j] = 0;
      if (is_worse()) y_[j] = change_[j];
    }
  }
  UpdateDeficientResiduals(hierarchy);
  return y_ != change_;
}

// Computes the residuals of the deficient levels at y, with rounding set to
// zero.
void WorkingSetProblem::UpdateDeficientResiduals(const Hierarchy& hierarchy) {
  ComputeRowResiduals(hierarchy);
  TakeDeficientResiduals();
}

// Sets the residuals of the deficient levels to those of the last
// ComputeRowResiduals(), with rounding set to zero.
void WorkingSetProblem::TakeDeficientResiduals() {
  for (int level = 0; level < num_leading_; ++level) {
    if (!leading_.is_deficient(level)) continue;
    const int first = leading_.first_row(level), end = leading_.end_row(level);
    double size = 0;
    for (int a = first; a < end; ++a) {
      nu_[a - first] = -row_residual_[a];
      size = std::max(size, size_[a]);
    }
    leading_.SetResiduals(level, nu_.data(), size);
  }
}

}  // namespace poise
