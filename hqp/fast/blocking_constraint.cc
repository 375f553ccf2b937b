// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// ActiveSetSearch: steps up to a blocking constraint, and the row that this one
// replaces.
#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/active_set_search.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {

// Moves y towards the optimum of the working set, up to the first bound outside
// the working set, and adds that bound to it. Among bounds at equal distance,
// this function adds the one of the largest excess. The result is its row, or
// no row.
RowIndex ActiveSetSearch::StepToBlockingConstraint(
    const Hierarchy& hierarchy, const WorkingSetProblem& problem,
    std::vector<std::vector<Side>>* side) {
  for (int j = 0; j < n_; ++j) step_[j] = problem.y()[j] - y_[j];
  const double largest = kernels::Largest(step_.data(), n_);
  const double rounding = tolerances::kSolutionRounding *
                          (kernels::Largest(y_.data(), n_) + problem.Size());
  const double noise = tolerances::kZeroSlope * largest + rounding;
  Blocking first;
  RowIndex added;
  for (int level = 0; level < problem.num_levels(); ++level) {
    const int rows = hierarchy.num_inequalities(level);
    const double* C = hierarchy.C(level).data();
    const Span* spans = hierarchy.C_span(level);
    kernels::SpanDots(C, n_, spans, rows, step_.data(), slope_.data());
    kernels::SpanDots(C, n_, spans, rows, y_.data(), value_.data());
    for (int i = 0; i < rows; ++i) {
      const Blocking row = FindBlocking(hierarchy, problem, {level, i},
                                        (*side)[level][i], noise);
      if (row.length < first.length ||
          (row.length == first.length && row.length < 1 &&
           row.excess > first.excess)) {
        first = row;
        added = {level, i};
      }
    }
  }
  if (added.level < 0) {
    y_ = problem.y();
    return added;
  }
  for (int j = 0; j < n_; ++j) y_[j] += first.length * step_[j];
  (*side)[added.level][added.row] = first.side;
  if (first.length * largest <= rounding && added == last_removed_) {
    // A removed row moves away from its bound. This one did not: rounding had
    // made its multiplier negative.
    removals_.Exhaust(added);
  }
  return added;
}

// Finds where a step blocks at a row, whose side in the working set is `side`.
// In a search that goes on, a bound that y violates at the start and at the end
// of the step blocks at once. In other searches, such rows are in the working
// set from the start. pre: value_ and slope_ are those of the row's level.
ActiveSetSearch::Blocking ActiveSetSearch::FindBlocking(
    const Hierarchy& hierarchy, const WorkingSetProblem& problem, RowIndex row,
    Side side, double noise) const {
  const double value = value_[row.row], slope = slope_[row.row];
  const double norm = problem.norm(row.level, row.row);
  const double upper = hierarchy.upper(row.level)[row.row];
  const double lower = hierarchy.lower(row.level)[row.row];
  if (norm == 0 || !removals_.MayChange(row)) return {};
  if (goes_on_ && (value > upper || value < lower)) {
    const Side violated = value > upper ? Side::kUpper : Side::kLower;
    const double start = value > upper ? value - upper : lower - value;
    const double end = value > upper ? start + slope : start - slope;
    const double rounding =
        norm *
        (noise + 2 * tolerances::kZeroSlope * kernels::Largest(y_.data(), n_));
    if (side != violated && std::min(start, end) > rounding) {
      return {violated, 0, end / norm};
    }
  }
  const Side towards = slope > 0 ? Side::kUpper : Side::kLower;
  if (side == towards || std::abs(slope) <= noise * norm) return {};
  const double gap = slope > 0 ? upper - value : lower - value;
  return {towards, std::max(gap / slope, 0.0), std::abs(slope) / norm};
}

// Removes a row from the working set if the row that a step has added depends
// on others. If y is at the bounds of the working set, a step does not change
// its rows, so it has no slope on a row that depends on them. In a search that
// goes on, y may be strictly inside some of these bounds. The step then changes
// their rows, and it can be blocked by a row that depends on them. With both,
// the level would be contradictory, and the next optimum would violate rows
// that y does not violate. So this function removes a row of which y is
// strictly inside the bound, and of which the next optimum is inside as well:
// the combination has a positive factor for it, if factors count towards the
// bounds. Lower levels come first.
void ActiveSetSearch::RemoveDependentRow(const Hierarchy& hierarchy,
                                         RowIndex added,
                                         WorkingSetProblem* problem,
                                         std::vector<std::vector<Side>>* side) {
  const double* row = hierarchy.C(added.level).data() + added.row * n_;
  const double* factors = problem->FindCombination(row).factors;
  if (factors == nullptr) return;
  const int rows = problem->leading().num_rows();
  const double rounding =
      tolerances::kZeroFactor * kernels::Largest(factors, rows);
  const double largest_y = kernels::Largest(y_.data(), n_);
  RowIndex removed;
  double largest = 0;
  for (int a = 0; a < rows; ++a) {
    const RowIndex index = {problem->row(a).level, problem->row(a).index};
    if (!problem->row(a).is_inequality) continue;
    const Side at = (*side)[index.level][index.row];
    const bool is_same_side = at == (*side)[added.level][added.row];
    const double factor = is_same_side ? factors[a] : -factors[a];
    if (factor <= rounding || index == added || !removals_.MayChange(index) ||
        !IsInside(hierarchy, *problem, index, at, largest_y)) {
      continue;
    }
    if (index.level > removed.level ||
        (index.level == removed.level && factor > largest)) {
      removed = index;
      largest = factor;
    }
  }
  if (removed.level < 0) return;
  (*side)[removed.level][removed.row] = Side::kNone;
  removals_.CountRemoval(removed);
}

// Returns whether y, whose largest entry is `largest`, is strictly inside the
// bound of a row.
bool ActiveSetSearch::IsInside(const Hierarchy& hierarchy,
                               const WorkingSetProblem& problem, RowIndex row,
                               Side side, double largest) const {
  double value;
  kernels::SpanDots(hierarchy.C(row.level).data() + row.row * n_, n_,
                    hierarchy.C_span(row.level) + row.row, 1, y_.data(),
                    &value);
  const double bound = side == Side::kUpper
                           ? hierarchy.upper(row.level)[row.row]
                           : hierarchy.lower(row.level)[row.row];
  const double inside = side == Side::kUpper ? bound - value : value - bound;
  const double size =
      problem.norm(row.level, row.row) * largest + std::abs(bound);
  return inside > tolerances::kZeroSlope * size;
}

}  // namespace poise
