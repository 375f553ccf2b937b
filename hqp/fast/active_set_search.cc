// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/fast/active_set_search.h"

#include <algorithm>
#include <cmath>

#include "hqp/fast/kernels.h"
#include "hqp/fast/tolerances.h"

namespace poise {
namespace {

// How often a row may leave on a level, or all at once: more than any search was
// seen to need, and few enough to end what rounding alone keeps going.
constexpr int kMaxRemovals = 10;

// In place of that: an equality, for good.
constexpr int kFrozen = -1;

constexpr int kNone = -1;

// Of a row whose sides are one.
bool IsFixed(const Hierarchy& hierarchy, int level, int i) {
  return hierarchy.lower(level)[i] == hierarchy.upper(level)[i];
}

}  // namespace

ActiveSetSearch::ActiveSetSearch(int num_variables,
                                 const std::vector<LevelCapacity>& capacity)
    : n_(num_variables), y_(num_variables), step_(num_variables) {
  int most = 0;
  for (const LevelCapacity& level : capacity) {
    removals_left_.emplace_back(level.inequalities, kMaxRemovals);
    violated_.emplace_back(level.inequalities, Side::kNone);
    completed_.emplace_back(level.inequalities, Side::kNone);
    most = std::max(most, level.inequalities);
  }
  value_.resize(most);
  slope_.resize(most);
}

bool ActiveSetSearch::AllAtOnce(const Hierarchy& hierarchy, int limit,
                                Budget* budget, WorkingSetProblem* problem,
                                std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  if (!budget->Take(limit)) return false;
  remove_together_ = true;
  problem->Plan(hierarchy, levels);
  problem->Solve(hierarchy, *side);
  if (!InitializeAllLevels(hierarchy, problem, side)) return true;
  // What is best for the head comes first: steps there are cheaper.
  do {
    if (!budget->Take(limit)) return false;
    problem->SolveLeading(hierarchy, *side);
    problem->Approach(y_);
  } while (Iterate(hierarchy, problem->num_leading() - 1, problem, side));
  problem->SolveDiagonal();
  while (Iterate(hierarchy, levels, problem, side)) {
    if (!budget->Take(limit)) return false;
    problem->Solve(hierarchy, *side);
  }
  return true;
}

int ActiveSetSearch::LevelByLevel(const Hierarchy& hierarchy, Budget* budget,
                                  WorkingSetProblem* problem,
                                  std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  remove_together_ = false;
  std::fill(y_.begin(), y_.end(), 0);
  for (std::vector<Side>& level : completed_) {
    std::fill(level.begin(), level.end(), Side::kNone);
  }
  for (int level = 0; level <= levels; ++level) {
    // Of all that are optimal on this level, the one closest to y; of all that
    // are on every level, the smallest.
    problem->Plan(hierarchy, std::min(level + 1, levels),
                  level < levels ? y_.data() : nullptr);
    if (level < levels) InitializeWorkingSet(hierarchy, level, side);
    bool has_changed = true;
    while (has_changed) {
      if (!budget->Take()) {
        RestoreWorkingSet(side);
        return level;
      }
      problem->Solve(hierarchy, *side);
      has_changed = Iterate(hierarchy, level, problem, side);
    }
    if (level < levels) FreezeViolated(level, *problem, *side);
    completed_ = *side;
  }
  return levels + 1;
}

// Back to the rows that were active when the last level was done, but for those
// that have left: what they held, nothing holds.
void ActiveSetSearch::RestoreWorkingSet(
    std::vector<std::vector<Side>>* side) const {
  for (size_t level = 0; level < completed_.size(); ++level) {
    for (size_t i = 0; i < completed_[level].size(); ++i) {
      Side& at = (*side)[level][i];
      if (at != completed_[level][i]) at = Side::kNone;
    }
  }
}

// Begins all levels at once; `problem` is solved for the active rows. Returns
// whether these change; if not, that is the optimum.
bool ActiveSetSearch::InitializeAllLevels(
    const Hierarchy& hierarchy, WorkingSetProblem* problem,
    std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  for (int level = 0; level < levels; ++level) {
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      removals_left_[level][i] =
          IsFixed(hierarchy, level, i) ? kFrozen : kMaxRemovals;
    }
  }
  const int violated_at_optimum =
      FindViolated(hierarchy, *problem, problem->y(), *side);
  if (violated_at_optimum == 0) {
    y_ = problem->y();
    return RemoveConstraints(levels, problem, side);
  }
  if (violated_at_optimum <= FindViolated(hierarchy, *problem, y_, *side)) {
    y_ = problem->y();
    FindViolated(hierarchy, *problem, y_, *side);
  }
  for (int level = 0; level < levels; ++level) {
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      if (violated_[level][i] == Side::kNone) continue;
      (*side)[level][i] = violated_[level][i];
    }
  }
  return true;
}

// Finds the sides that y breaks, but for those that are active. Returns how
// many.
int ActiveSetSearch::FindViolated(const Hierarchy& hierarchy,
                                  const WorkingSetProblem& problem,
                                  const std::vector<double>& y,
                                  const std::vector<std::vector<Side>>& side) {
  const double largest = kernels::Largest(y.data(), n_);
  const double rounding = tolerances::kSolutionRounding * problem.Size();
  int count = 0;
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    kernels::Dots(hierarchy.C(level).data(), n_, rows, y.data(), n_,
                  value_.data());
    for (int i = 0; i < rows; ++i) {
      violated_[level][i] = Side::kNone;
      const double above = value_[i] - upper[i], below = lower[i] - value_[i];
      if ((above <= 0 && below <= 0) || removals_left_[level][i] == kFrozen ||
          problem.norm(level, i) == 0) {
        continue;
      }
      const Side violated = above > 0 ? Side::kUpper : Side::kLower;
      const double bound = above > 0 ? upper[i] : lower[i];
      const double norm = problem.norm(level, i);
      const double noise =
          tolerances::kZeroSlope * (norm * largest + std::abs(bound)) +
          rounding * norm;
      if (violated != side[level][i] && std::max(above, below) > noise) {
        violated_[level][i] = violated;
        ++count;
      }
    }
  }
  return count;
}

// The rows of a level that are violated are active to begin with.
void ActiveSetSearch::InitializeWorkingSet(
    const Hierarchy& hierarchy, int level,
    std::vector<std::vector<Side>>* side) {
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  const int rows = hierarchy.num_inequalities(level);
  kernels::Dots(hierarchy.C(level).data(), n_, rows, y_.data(), n_,
                value_.data());
  for (int i = 0; i < rows; ++i) {
    removals_left_[level][i] =
        IsFixed(hierarchy, level, i) ? kFrozen : kMaxRemovals;
    (*side)[level][i] = value_[i] > upper[i] || lower[i] == upper[i]
                            ? Side::kUpper
                        : value_[i] < lower[i] ? Side::kLower
                                               : Side::kNone;
  }
}

// Goes towards the solution of the problem; if it gets there, lets rows leave.
// Returns whether the active rows change; if not, the levels up to this one are
// at their optimum.
bool ActiveSetSearch::Iterate(const Hierarchy& hierarchy, int level,
                              WorkingSetProblem* problem,
                              std::vector<std::vector<Side>>* side) {
  return StepToBlockingConstraint(hierarchy, *problem, side) ||
         RemoveConstraints(level, problem, side);
}

// Goes towards the solution of the problem as far as the other rows, and the
// other sides of active rows, allow. Returns whether a row is in the way, now
// active.
bool ActiveSetSearch::StepToBlockingConstraint(
    const Hierarchy& hierarchy, const WorkingSetProblem& problem,
    std::vector<std::vector<Side>>* side) {
  for (int j = 0; j < n_; ++j) step_[j] = problem.y()[j] - y_[j];
  const double largest = kernels::Largest(step_.data(), n_);
  const double rounding = tolerances::kSolutionRounding *
                          (kernels::Largest(y_.data(), n_) + problem.Size());
  const double noise = tolerances::kZeroSlope * largest + rounding;
  double length = 1, steepest = 0;
  RowIndex blocking = {kNone, kNone};
  Side at = Side::kNone;
  for (int level = 0; level < problem.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    const double* C = hierarchy.C(level).data();
    kernels::Dots(C, n_, rows, step_.data(), n_, slope_.data());
    kernels::Dots(C, n_, rows, y_.data(), n_, value_.data());
    for (int i = 0; i < rows; ++i) {
      const double slope = slope_[i], norm = problem.norm(level, i);
      const Side towards = slope > 0 ? Side::kUpper : Side::kLower;
      if ((*side)[level][i] == towards || removals_left_[level][i] <= 0 ||
          std::abs(slope) <= noise * norm) {
        continue;
      }
      const double gap =
          slope > 0 ? upper[i] - value_[i] : lower[i] - value_[i];
      const double ratio = std::max(gap / slope, 0.0);
      const double steepness = std::abs(slope) / norm;
      if (ratio < length ||
          (ratio == length && ratio < 1 && steepness > steepest)) {
        length = ratio;
        steepest = steepness;
        blocking = {level, i};
        at = towards;
      }
    }
  }
  const bool has_moved = length * largest > rounding;
  if (blocking.level == kNone) {
    y_ = problem.y();
    return false;
  }
  for (int j = 0; j < n_; ++j) y_[j] += length * step_[j];
  (*side)[blocking.level][blocking.row] = at;
  if (!has_moved && blocking.level == last_removed_.level &&
      blocking.row == last_removed_.row) {
    // What leaves moves away from its bound: it was for rounding that it left.
    removals_left_[blocking.level][blocking.row] = 0;
  }
  return true;
}

// Lets the rows go that are inside their own bound (the first ones of a descent
// in company of all that only the tail draws along: steps are dear there); or else
// the one that holds the levels up to this one back most. Returns whether one
// does.
bool ActiveSetSearch::RemoveConstraints(int level, WorkingSetProblem* problem,
                                        std::vector<std::vector<Side>>* side) {
  int removed = kNone;
  double worst = 0;
  bool has_multipliers = false, any = false;
  last_removed_ = {kNone, kNone};
  for (int a = 0; a < problem->leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem->row(a);
    if (!row.is_inequality || removals_left_[row.level][row.index] <= 0) {
      continue;
    }
    if (!has_multipliers) problem->FindMultipliers(level + 1);
    has_multipliers = true;
    Side& at = (*side)[row.level][row.index];
    double multiplier = 0;
    int l = row.level;
    while (l <= level && multiplier == 0)
      multiplier = problem->Multiplier(a, l++, at, tolerances::kZeroMultiplier);
    if (multiplier >= 0) continue;
    if (l == row.level + 1 ||
        (remove_together_ && l > problem->num_leading())) {
      at = Side::kNone;
      --removals_left_[row.level][row.index];
      any = true;
    } else if (multiplier < worst) {
      removed = a;
      worst = multiplier;
    }
  }
  if (any) remove_together_ = false;
  if (any || removed == kNone) return any;
  const WorkingSetProblem::Row& row = problem->row(removed);
  last_removed_ = {row.level, row.index};
  (*side)[row.level][row.index] = Side::kNone;
  --removals_left_[row.level][row.index];
  return true;
}

// What a level leaves violated stays so; what rounding held may leave again.
void ActiveSetSearch::FreezeViolated(
    int level, const WorkingSetProblem& problem,
    const std::vector<std::vector<Side>>& side) {
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem.row(a);
    if (!row.is_inequality) continue;
    int& removals_left = removals_left_[row.level][row.index];
    if (row.level == level &&
        problem.Multiplier(a, level, side[level][row.index],
                           tolerances::kZeroMultiplier) > 0) {
      removals_left = kFrozen;
    }
    if (removals_left != kFrozen) removals_left = kMaxRemovals;
  }
}

}  // namespace poise
