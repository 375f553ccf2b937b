// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/parametric_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "poise/hqp/fast/infinitesimals.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/same_sides.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

// Most rows without a multiplier that one iteration removes. One iteration must
// not take long: where a limit of time interrupts it, its work is lost.
constexpr int kMaxRemoved = 4;

// A path is given up after so many iterations of one solve in a row that add
// and remove rows in turn. On recorded robots, such a path goes from vertex to
// vertex in steps of 1e-7 to 1e-2 of its length. The primal method takes longer
// steps. With 12, some falls take longer
// (docs/notebook/2026-11-29-alternations.md).
constexpr int kMaxAlternations = 16;

}  // namespace

ParametricSearch::ParametricSearch(int num_variables,
                                   const std::vector<LevelCapacity>& capacity)
    : n_(num_variables),
      y_(num_variables),
      start_(capacity, num_variables, static_cast<int>(capacity.size()) + 1),
      center_(num_variables),
      removals_(capacity) {
  int most = 0;
  for (const LevelCapacity& level : capacity) {
    side_.emplace_back(level.inequalities, Side::kNone);
    most = std::max(most, level.inequalities);
  }
  near_side_ = side_;
  end_value_.resize(most);
  for (std::vector<double>* number :
       {&end_, &time_, &scratch_, &removal_time_}) {
    number->resize(capacity.size() + 1);
  }
}

void ParametricSearch::Remember(const WorkingSetProblem& problem,
                                const Sides& side) {
  side_ = side;
  is_known_ = true;
  is_paused_ = skips_near_ = false;
  start_.Clear();
  const int size = problem.num_levels() + 1;
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem.row(a);
    if (!row.is_inequality) continue;
    std::copy_n(EndMultiplier(problem, size, side, a), size,
                start_.At(row.level, row.index));
  }
}

void ParametricSearch::Pause(const Sides& side) {
  TakeWorkingSet(side);
  is_paused_ = true;
}

// Replaces side_ by `side`. A row whose side differs has no multiplier from
// then on.
void ParametricSearch::TakeWorkingSet(const Sides& side) {
  for (size_t level = 0; level < side.size(); ++level) {
    if (AreSame(side[level], side_[level])) continue;
    for (size_t i = 0; i < side[level].size(); ++i) {
      if (side[level][i] == side_[level][i]) continue;
      start_.Remove(static_cast<int>(level), static_cast<int>(i));
    }
  }
  side_ = side;
}

bool ParametricSearch::Follow(const Hierarchy& hierarchy, int limit,
                              Budget* budget, WorkingSetProblem* problem,
                              Sides* side) {
  // The limits hold for one solve. A cycle over several solves ends when the
  // solver starts over.
  removals_.Reset(hierarchy);
  skips_near_ = false;
  TakeWorkingSet(*side);
  Run run;
  for (Change last;;) {
    const int size = problem->num_levels() + 1;
    problem->FindMultipliers(size);
    const RowIndex flipped = std::exchange(flipped_, {});
    if (RemoveVanished(*problem, size, &last, side)) {
      // The flip was wrong if its row had to be removed.
      if (flipped.level >= 0 &&
          (*side)[flipped.level][flipped.row] == Side::kNone) {
        predicts_flip_ = false;
      }
      run.Count(false);
    } else if (Step(hierarchy, problem, &last, side)) {
      run.Count(last);
    } else {
      y_ = problem->y();
      return true;
    }
    const bool goes_on = run.alternations < kMaxAlternations &&
                         budget->Take(limit, problem->work());
    if (goes_on) LookAhead(hierarchy, *problem, run, &last, side);
    if (!goes_on || !problem->SolveWithin(hierarchy, *side, budget)) {
      side_ = *side;
      return false;
    }
  }
}

// Moves y and the multipliers to the next change of the working set, and makes
// this change. If there is none before the end of the path, this returns false
// and moves nothing.
bool ParametricSearch::Step(const Hierarchy& hierarchy,
                            WorkingSetProblem* problem, Change* last,
                            Sides* side) {
  const int num_levels = problem->num_levels(), size = num_levels + 1;
  const Blocking blocking =
      FindBlocking(hierarchy, *problem, num_levels, *last, *side);
  RowIndex removed = FindRemoval(*problem, size, *last, *side);
  if (blocking.side == Side::kNone && removed.level < 0) return false;
  std::fill(time_.begin(), time_.end(), 0);
  time_[0] = blocking.time;
  const bool removes =
      removed.level >= 0 &&
      (blocking.side == Side::kNone ||
       !infinitesimals::IsLess(time_.data(), removal_time_.data(), size));
  if (removes) time_ = removal_time_;
  Advance(*problem, size, *side);
  if (removes) {
    start_.Remove(removed.level, removed.row);
    const bool may_flip = MayFlip(hierarchy, removed);
    if (may_flip && predicts_flip_) {
      *last = Flip(removed, side);
      flipped_ = removed;
    } else {
      *last = Remove(removed, side);
      last->may_flip = may_flip;
    }
    return true;
  }
  if (last->may_flip && blocking.row == last->removed) predicts_flip_ = true;
  removed = Exchange(hierarchy, blocking, size, *last, *side, problem);
  *last = Add(blocking, side);
  if (removed.level < 0) return true;
  (void)Remove(removed, side);
  last->is_exchange = true;
  // Only a row without a multiplier must stay.
  const double* multiplier = start_.At(blocking.row.level, blocking.row.row);
  if (infinitesimals::Sign(multiplier, size) > 0) last->added = {};
  return true;
}

// Removes rows whose multiplier is zero at the time that has been reached and
// negative at the end of the path, kMaxRemoved at most. Returns whether there
// was one. The row that was added last stays protected from removal, and one
// that is removed alone from being added.
bool ParametricSearch::RemoveVanished(const WorkingSetProblem& problem,
                                      int size, Change* last, Sides* side) {
  int removed = 0;
  Change change;
  for (int a = 0; a < problem.leading().num_rows() && removed < kMaxRemoved;
       ++a) {
    const RowIndex row = {problem.row(a).level, problem.row(a).index};
    if (!problem.row(a).is_inequality ||
        infinitesimals::Sign(start_.At(row.level, row.row), size) > 0 ||
        !MayRemove(problem, size, *last, *side, a)) {
      continue;
    }
    start_.Remove(row.level, row.row);
    change = Remove(row, side);
    ++removed;
  }
  if (removed == 0) return false;
  if (removed > 1) change = {};
  change.added = last->added;
  *last = change;
  return true;
}

// Returns the largest rounding of a step to the end of the path.
double ParametricSearch::Noise(const WorkingSetProblem& problem) const {
  double largest = 0;
  for (int j = 0; j < n_; ++j) {
    largest = std::max(largest, std::abs(problem.y()[j] - y_[j]));
  }
  return tolerances::kZeroSlope * largest +
         tolerances::kSolutionRounding *
             (kernels::Largest(y_.data(), n_) + problem.Size());
}

// Returns whether and when a row blocks the path, at whose end it has the value
// `end_value`. pre: the row is not in the working set, and `end_value` is
// outside its bounds.
ParametricSearch::Blocking ParametricSearch::FindTime(
    const Hierarchy& hierarchy, const WorkingSetProblem& problem, RowIndex row,
    double end_value, double noise, const Change& last) const {
  const double upper = hierarchy.upper(row.level)[row.row];
  const double lower = hierarchy.lower(row.level)[row.row];
  const bool is_above = end_value > upper;
  const Side at = is_above ? Side::kUpper : Side::kLower;
  const double bound = is_above ? upper : lower;
  const double beyond = is_above ? end_value - bound : bound - end_value;
  const double norm = problem.norm(row.level, row.row);
  if (!removals_.MayChange(row) || norm == 0 ||
      (row == last.removed && at == last.removed_side) ||
      beyond <= noise * norm + tolerances::kZeroSlope * std::abs(bound)) {
    return {};
  }
  double value;
  kernels::SpanDots(hierarchy.C(row.level).data() + row.row * n_, n_,
                    hierarchy.C_span(row.level) + row.row, 1, y_.data(),
                    &value);
  const double left = is_above ? bound - value : value - bound;
  return {row, at, left > 0 ? left / (left + beyond) : 0, beyond / norm};
}

// Finds the first blocking constraint outside the working set. A bound that y
// violates at the start and at the end of the path blocks at once. Among bounds
// at equal time, the end violates the returned one most.
ParametricSearch::Blocking ParametricSearch::FindBlocking(
    const Hierarchy& hierarchy, const WorkingSetProblem& problem,
    int num_levels, const Change& last, const Sides& side) {
  const double noise = Noise(problem);
  Blocking first;
  for (int level = 0; level < num_levels; ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    kernels::SpanDots(hierarchy.C(level).data(), n_, hierarchy.C_span(level),
                      rows, problem.y().data(), end_value_.data());
    for (int i = 0; i < rows; ++i) {
      const double value = end_value_[i];
      if ((value <= upper[i] && value >= lower[i]) ||
          side[level][i] != Side::kNone) {
        continue;
      }
      const Blocking row =
          FindTime(hierarchy, problem, {level, i}, value, noise, last);
      if (row.side != Side::kNone &&
          (row.time < first.time ||
           (row.time == first.time && row.excess > first.excess))) {
        first = row;
      }
    }
  }
  return first;
}

// Finds the row whose multiplier becomes negative first, and the time at which
// this multiplier is zero: 0 if it is not positive at the start.
RowIndex ParametricSearch::FindRemoval(const WorkingSetProblem& problem,
                                       int size, const Change& last,
                                       const Sides& side) {
  RowIndex removed;
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    if (!MayRemove(problem, size, last, side, a)) continue;
    const RowIndex row = {problem.row(a).level, problem.row(a).index};
    const double* start = start_.At(row.level, row.row);
    if (infinitesimals::Sign(start, size) > 0) {
      if (removed.level >= 0 &&
          infinitesimals::FirstOfZero(start, end_.data()) > removal_time_[0]) {
        continue;
      }
      infinitesimals::FindZero(start, end_.data(), size, scratch_.data(),
                               time_.data());
    } else {
      std::fill(time_.begin(), time_.end(), 0);
    }
    if (removed.level < 0 ||
        infinitesimals::IsLess(time_.data(), removal_time_.data(), size)) {
      removed = row;
      removal_time_ = time_;
    }
  }
  return removed;
}

// Returns whether row a may be removed, and its multiplier at the end of the
// path is negative. That multiplier is then in end_. The row that was added
// last stays: only rounding can make its multiplier negative. A row that was
// removed already has the multiplier zero.
bool ParametricSearch::MayRemove(const WorkingSetProblem& problem, int size,
                                 const Change& last, const Sides& side, int a) {
  const WorkingSetProblem::Row& row = problem.row(a);
  const RowIndex index = {row.level, row.index};
  if (!row.is_inequality || !removals_.MayChange(index) ||
      index == last.added ||
      !IsNegativeAtEnd(problem, size, side[row.level][row.index], a)) {
    return false;
  }
  (void)EndMultiplier(problem, size, side, a);
  return true;
}

// Returns whether the multiplier of row a at the end of the path is negative:
// its first coefficient that is not zero.
bool ParametricSearch::IsNegativeAtEnd(const WorkingSetProblem& problem,
                                       int size, Side side, int a) {
  double coefficient = 0;
  for (int level = problem.row(a).level; level < size && coefficient == 0;
       ++level) {
    coefficient =
        problem.Multiplier(a, level, side, tolerances::kZeroMultiplier);
  }
  return coefficient < 0;
}

// Computes the multiplier of row a at the end of the path, with `size`
// coefficients. On its own level, it is the weighted residual.
const double* ParametricSearch::EndMultiplier(const WorkingSetProblem& problem,
                                              int size, const Sides& side,
                                              int a) {
  const WorkingSetProblem::Row& row = problem.row(a);
  std::fill_n(end_.begin(), row.level, 0);
  for (int level = row.level; level < size; ++level) {
    end_[level] = problem.Multiplier(a, level, side[row.level][row.index],
                                     tolerances::kZeroMultiplier);
  }
  end_[row.level] *= problem.leading().weight(a);
  return end_.data();
}

// Moves y and the multipliers of the working set to time_.
void ParametricSearch::Advance(const WorkingSetProblem& problem, int size,
                               const Sides& side) {
  StepTo(problem.y(), time_[0]);
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem.row(a);
    if (!row.is_inequality) continue;
    infinitesimals::Approach(time_.data(),
                             EndMultiplier(problem, size, side, a), size,
                             start_.At(row.level, row.index));
  }
}

void ParametricSearch::StepTo(const std::vector<double>& y, double time) {
  for (int j = 0; j < n_; ++j) y_[j] += time * (y[j] - y_[j]);
}

ParametricSearch::Change ParametricSearch::Remove(RowIndex row, Sides* side) {
  removals_.CountRemoval(row);
  return {{}, row, std::exchange((*side)[row.level][row.row], Side::kNone)};
}

ParametricSearch::Change ParametricSearch::Add(const Blocking& blocking,
                                               Sides* side) {
  (*side)[blocking.row.level][blocking.row.row] = blocking.side;
  return {blocking.row, {}, Side::kNone};
}

void FitToBounds(const Hierarchy& hierarchy, ParametricSearch::Sides* side) {
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      Side& at = (*side)[level][i];
      if (lower[i] == upper[i]) {
        at = Side::kUpper;
      } else if ((at == Side::kUpper &&
                  upper[i] > tolerances::kInfiniteBound) ||
                 (at == Side::kLower &&
                  lower[i] < -tolerances::kInfiniteBound)) {
        at = Side::kNone;
      }
    }
  }
}

}  // namespace poise
