// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/active_set_search.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/cost_order.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

// Longest path, in iterations. After more iterations, steps of the primal
// method are likely to reach the optimum first: they need not follow each
// change of the working set between the last optimum and this one. No longer
// path is better for all sequences (docs/notebook/2026-11-28-look-ahead.md).
constexpr int kLongPath = 25;

// The share of the time for a path whose start does not meet the levels before
// the last. Of 0.7, 0.75, 0.8, 0.85, 0.9 and 0.95, this is the largest with
// which no recorded robot that stays up loses limits or feet in 300 us
// (docs/notebook/2026-12-01-path-first.md).
constexpr double kShareOfPath = 0.8;

// How often a search removes many rows together, see RemoveConstraints(). With
// 4 and 10 the worst ticks are the same (docs/notebook/2026-11-28-groups.md).
constexpr int kMaxTogether = 4;

}  // namespace

ActiveSetSearch::ActiveSetSearch(int num_variables,
                                 const std::vector<LevelCapacity>& capacity)
    : n_(num_variables),
      path_(num_variables, capacity),
      y_(num_variables),
      set_optimum_(num_variables),
      step_(num_variables),
      removals_(capacity) {
  int most = 0;
  for (const LevelCapacity& level : capacity) {
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
  if (!budget->Take(limit, problem->work())) return false;
  problem->Plan(hierarchy, hierarchy.num_levels());
  if (path_.is_known()) {
    switch (FollowPath(hierarchy, limit, budget, problem, side)) {
      case PathEnd::kOptimum:
        return true;
      case PathEnd::kBudget:
        return false;
      case PathEnd::kGivenUp:
        break;
    }
    if (!budget->Take(limit, problem->work())) return false;
    problem->UseAllLeading();
    if (!problem->SolveWithin(hierarchy, *side, budget)) return false;
  } else {
    problem->Start(hierarchy, *side, &y_);
    problem->SolveDiagonal();
  }
  if (!SearchFromOptimum(hierarchy, limit, budget, problem, side)) return false;
  goes_on_ = false;
  problem->FindMultipliers(hierarchy.num_levels() + 1);
  path_.Remember(*problem, *side);
  return true;
}

// Starts a search on all levels, and follows the path from the last optimum.
// With a limit of time, all leading levels but the last are met before, or else
// in the time that the path leaves: an answer that is cut off loses momentum
// before limits and feet.
ActiveSetSearch::PathEnd ActiveSetSearch::FollowPath(
    const Hierarchy& hierarchy, int limit, Budget* budget,
    WorkingSetProblem* problem, std::vector<std::vector<Side>>* side) {
  using Meeting = ParametricSearch::Meeting;
  Meeting meeting = Meeting::kMet;
  path_.Begin(y_);
  if (budget->has_time_limit()) {
    meeting = path_.MeetLevelsBeforeLast(hierarchy, limit, budget, problem,
                                         side, &y_);
  } else {
    problem->Start(hierarchy, *side, path_.mutable_y());
    y_ = path_.y();
  }
  const bool is_followed = meeting != Meeting::kCutOff;
  const bool is_postponed = meeting == Meeting::kPostponed;
  if (is_followed) {
    problem->SolveDiagonal();
    set_optimum_ = problem->y();
    // With a limit of time, a long path goes on in the next solve.
    const int longest = budget->has_time_limit()
                            ? limit
                            : std::min(limit, budget->iterations() + kLongPath);
    if (is_postponed) budget->set_share(kShareOfPath);
    const bool has_ended =
        path_.Follow(hierarchy, longest, budget, problem, side);
    budget->set_share(1);
    if (has_ended) {
      y_ = path_.y();
      goes_on_ = false;
      path_.Remember(*problem, *side);
      return PathEnd::kOptimum;
    }
    if (budget->is_spent()) path_.Pause(*side);
  }
  // A path need not lower the cost at each step.
  if (IsBetter(hierarchy, path_.y(), y_)) y_ = path_.y();
  if (is_followed && IsBetter(hierarchy, set_optimum_, y_)) y_ = set_optimum_;
  if (budget->is_spent()) return PathEnd::kBudget;
  if (is_postponed && budget->is_share_spent()) {
    (void)path_.PauseAtLevelsBeforeLast(hierarchy, limit, budget, problem, side,
                                        &y_);
    budget->Spend();
    return PathEnd::kBudget;
  }
  path_.Resume(side);
  path_.Forget();
  goes_on_ = true;
  return PathEnd::kGivenUp;
}

// Searches from the optimum of the working set, for which `problem` is solved,
// or from y, see AllAtOnce().
bool ActiveSetSearch::SearchFromOptimum(const Hierarchy& hierarchy, int limit,
                                        Budget* budget,
                                        WorkingSetProblem* problem,
                                        std::vector<std::vector<Side>>* side) {
  num_together_ = kMaxTogether;
  last_removed_ = {};
  // A search that goes on adds the violated rows one by one, so that each can
  // replace a row that it depends on. With a limit of time, these are too many
  // iterations.
  const bool adds_violated = !goes_on_ || budget->has_time_limit();
  if (!InitializeAllLevels(hierarchy, adds_violated, problem, side))
    return true;
  // The leading levels come first, because their steps are cheaper. With a
  // limit of time, all of them but the last are searched alone before. If these
  // need no step, the last one gets theirs: else a small budget would never
  // reach it.
  const int leading = problem->num_leading();
  int used = budget->has_time_limit() ? std::max(leading - 1, 1) : leading;
  for (bool is_free = false; used <= leading; ++used) {
    int iterations = 0;
    do {
      if (!is_free && !budget->Take(limit, problem->work())) {
        return false;
      }
      is_free = false;
      ++iterations;
      problem->UseLeading(used);
      if (!problem->SolveLeadingWithin(hierarchy, *side, budget)) return false;
      problem->Approach(y_);
    } while (Iterate(hierarchy, used - 1, problem, side));
    is_free = iterations == 1;
  }
  problem->SolveDiagonal();
  while (Iterate(hierarchy, problem->num_levels(), problem, side)) {
    if (!budget->Take(limit, problem->work()) ||
        !problem->SolveWithin(hierarchy, *side, budget)) {
      return false;
    }
  }
  return true;
}

int ActiveSetSearch::LevelByLevel(const Hierarchy& hierarchy, Budget* budget,
                                  WorkingSetProblem* problem,
                                  std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  num_together_ = 0;
  last_removed_ = {};
  goes_on_ = false;
  std::fill(y_.begin(), y_.end(), 0);
  for (std::vector<Side>& level : completed_) {
    std::fill(level.begin(), level.end(), Side::kNone);
  }
  for (int level = 0; level <= levels; ++level) {
    // Among the optima of this level, take the one closest to y. Among the
    // optima of all levels, take the one of minimum norm.
    problem->Plan(hierarchy, std::min(level + 1, levels),
                  level < levels ? y_.data() : nullptr);
    if (level < levels) InitializeWorkingSet(hierarchy, level, side);
    bool has_changed = true;
    while (has_changed) {
      if (!budget->Take(problem->work()) ||
          !problem->SolveWithin(hierarchy, *side, budget)) {
        RestoreWorkingSet(side);
        return level;
      }
      has_changed = Iterate(hierarchy, level, problem, side);
    }
    if (level < levels) FreezeViolated(level, *problem, *side);
    completed_ = *side;
  }
  return levels + 1;
}

// Restores the working set of the last solved level. Rows removed since then
// stay removed, because no multiplier keeps them at their bound.
void ActiveSetSearch::RestoreWorkingSet(
    std::vector<std::vector<Side>>* side) const {
  for (size_t level = 0; level < completed_.size(); ++level) {
    for (size_t i = 0; i < completed_[level].size(); ++i) {
      Side& at = (*side)[level][i];
      if (at != completed_[level][i]) at = Side::kNone;
    }
  }
}

// Initializes the search on all levels; `problem` is solved for the working
// set. Returns whether the search must go on. If not, y is the optimum.
bool ActiveSetSearch::InitializeAllLevels(
    const Hierarchy& hierarchy, bool adds_violated, WorkingSetProblem* problem,
    std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  removals_.Reset(hierarchy);
  const int violated_at_optimum =
      FindViolated(hierarchy, *problem, problem->y(), *side);
  if (violated_at_optimum == 0) {
    y_ = problem->y();
    return RemoveConstraints(levels, problem, side);
  }
  // Fewer violated rows need fewer iterations. But what a search has reached
  // before it was stopped must not be lost.
  if (goes_on_ ? IsBetter(hierarchy, problem->y(), y_)
               : violated_at_optimum <=
                     FindViolated(hierarchy, *problem, y_, *side)) {
    y_ = problem->y();
  }
  if (!adds_violated) return true;
  FindViolated(hierarchy, *problem, y_, *side);
  for (int level = 0; level < levels; ++level) {
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      if (violated_[level][i] == Side::kNone) continue;
      (*side)[level][i] = violated_[level][i];
    }
  }
  return true;
}

// Finds the bounds outside the working set that y violates. Returns their
// number.
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
    kernels::SpanDots(hierarchy.C(level).data(), n_, hierarchy.C_span(level),
                      rows, y.data(), value_.data());
    for (int i = 0; i < rows; ++i) {
      violated_[level][i] = Side::kNone;
      const double above = value_[i] - upper[i], below = lower[i] - value_[i];
      if ((above <= 0 && below <= 0) || removals_.IsFrozen({level, i}) ||
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

void ActiveSetSearch::Stop(const Hierarchy& hierarchy,
                           const WorkingSetProblem& problem,
                           std::vector<std::vector<Side>>* side) {
  goes_on_ = true;
  if (path_.is_paused()) return;
  const double largest = kernels::Largest(y_.data(), n_);
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      Side& at = (*side)[level][i];
      if (at != Side::kNone &&
          IsInside(hierarchy, problem, {level, i}, at, largest)) {
        at = Side::kNone;
      }
    }
  }
}

// Initializes the working set of a level with the rows that y violates.
void ActiveSetSearch::InitializeWorkingSet(
    const Hierarchy& hierarchy, int level,
    std::vector<std::vector<Side>>* side) {
  removals_.Reset(hierarchy, level);
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  const int rows = hierarchy.num_inequalities(level);
  kernels::SpanDots(hierarchy.C(level).data(), n_, hierarchy.C_span(level),
                    rows, y_.data(), value_.data());
  for (int i = 0; i < rows; ++i) {
    (*side)[level][i] = value_[i] > upper[i] || lower[i] == upper[i]
                            ? Side::kUpper
                        : value_[i] < lower[i] ? Side::kLower
                                               : Side::kNone;
  }
}

// Makes one iteration: a step to a blocking constraint, or, if there is none, a
// removal. Returns whether the working set changes. If not, the levels up to
// this one are at their optimum.
bool ActiveSetSearch::Iterate(const Hierarchy& hierarchy, int level,
                              WorkingSetProblem* problem,
                              std::vector<std::vector<Side>>* side) {
  const RowIndex added = StepToBlockingConstraint(hierarchy, *problem, side);
  if (added.level < 0) return RemoveConstraints(level, problem, side);
  if (goes_on_) RemoveDependentRow(hierarchy, added, problem, side);
  return true;
}

// Removes constraints with a negative multiplier from the working set: all that
// are strictly inside their bound, or else the one with the most negative
// multiplier. In the first such iterations of a search, num_together_ of them,
// all whose multiplier comes from a diagonal level are removed as well, because
// a step there is expensive. Returns whether a constraint was removed.
bool ActiveSetSearch::RemoveConstraints(int level, WorkingSetProblem* problem,
                                        std::vector<std::vector<Side>>* side) {
  int removed = -1;
  double worst = 0;
  bool has_multipliers = false, any = false;
  last_removed_ = {};
  for (int a = 0; a < problem->leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem->row(a);
    const RowIndex index = {row.level, row.index};
    if (!row.is_inequality || !removals_.MayChange(index)) continue;
    if (!has_multipliers) problem->FindMultipliers(level + 1);
    has_multipliers = true;
    Side& at = (*side)[row.level][row.index];
    double multiplier = 0;
    int l = row.level;
    while (l <= level && multiplier == 0)
      multiplier = problem->Multiplier(a, l++, at, tolerances::kZeroMultiplier);
    if (multiplier >= 0) continue;
    if (l == row.level + 1 ||
        (num_together_ > 0 && l > problem->num_leading())) {
      at = Side::kNone;
      removals_.CountRemoval(index);
      any = true;
    } else if (multiplier < worst) {
      removed = a;
      worst = multiplier;
    }
  }
  if (any) num_together_ = std::max(num_together_ - 1, 0);
  if (any || removed < 0) return any;
  const WorkingSetProblem::Row& row = problem->row(removed);
  last_removed_ = {row.level, row.index};
  (*side)[row.level][row.index] = Side::kNone;
  removals_.CountRemoval(last_removed_);
  return true;
}

// Turns the rows of a level that are violated at its optimum into equalities. A
// row without removals left blocks no step, so that later levels could violate
// it. So all other rows up to this level get their removals again.
void ActiveSetSearch::FreezeViolated(
    int level, const WorkingSetProblem& problem,
    const std::vector<std::vector<Side>>& side) {
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem.row(a);
    if (row.is_inequality && row.level == level &&
        problem.Multiplier(a, level, side[level][row.index],
                           tolerances::kZeroMultiplier) > 0) {
      removals_.Freeze({row.level, row.index});
    }
  }
  for (int above = 0; above <= level; ++above) {
    const int rows = static_cast<int>(side[above].size());
    for (int i = 0; i < rows; ++i) removals_.Renew({above, i});
  }
}

}  // namespace poise
