// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// ParametricSearch: the move to a nearby point that meets all leading levels
// but the last, before the path or after it has been paused.
#include <algorithm>

#include "poise/hqp/fast/cost_order.h"
#include "poise/hqp/fast/parametric_search.h"

namespace poise {
namespace {

// Rows with a negative multiplier of the distance are only removed if it is at
// least this part of the most negative one. Others would often be added again.
// Of 0, 0.03, 0.05, 0.08, 0.1 and 0.15, this value loses momentum in the fewest
// ticks (docs/notebook/2026-11-29-answers.md).
constexpr double kLargeMultiplier = 0.03;

}  // namespace

ParametricSearch::Meeting ParametricSearch::MeetLevelsBeforeLast(
    const Hierarchy& hierarchy, int limit, Budget* budget,
    WorkingSetProblem* problem, Sides* side, std::vector<double>* answer) {
  const int leading = problem->num_leading();
  // If the last solve spent its budget here, the path must advance as well.
  const bool may_move = leading > 1 && !skips_near_;
  // The working set of a path that was paused is far from that of y.
  if (!may_move || !is_continued_ || !is_near_known_) {
    problem->Start(hierarchy, *side, &y_);
    *answer = y_;
    if (!may_move) return Meeting::kMet;
    removals_.Reset(hierarchy);
    problem->Approach(y_, leading - 1);
    if (FindBlocking(hierarchy, *problem, leading - 1, {}, *side).side !=
        Side::kNone) {
      return Meeting::kPostponed;
    }
    y_ = problem->y();
    if (IsBetter(hierarchy, y_, *answer)) *answer = y_;
    return Meeting::kMet;
  }
  problem->UseLeading(leading - 1);
  FitToBounds(hierarchy, &near_side_);
  std::copy(side->begin() + leading - 1, side->end(),
            near_side_.begin() + leading - 1);
  problem->Start(hierarchy, near_side_, &y_);
  *answer = y_;
  skips_near_ = true;
  if (!FindNearest(hierarchy, limit, budget, problem, &near_side_) ||
      !budget->Take(limit, problem->WorkWith(hierarchy, *side))) {
    Pause(*side);
    *side = near_side_;
    return Meeting::kCutOff;
  }
  if (IsBetter(hierarchy, y_, *answer)) *answer = y_;
  problem->UseLeading(leading);
  // This is not interrupted: the levels that y meets would then have no
  // multipliers.
  problem->SolveLeading(hierarchy, *side);
  return Meeting::kMet;
}

bool ParametricSearch::PauseAtLevelsBeforeLast(const Hierarchy& hierarchy,
                                               int limit, Budget* budget,
                                               WorkingSetProblem* problem,
                                               Sides* side,
                                               std::vector<double>* answer) {
  problem->UseLeading(problem->num_leading() - 1);
  near_side_ = *side;
  is_near_known_ = true;
  const bool is_found =
      FindNearest(hierarchy, limit, budget, problem, &near_side_);
  Pause(*side);
  *side = near_side_;
  if (is_found && IsBetter(hierarchy, y_, *answer)) *answer = y_;
  return is_found;
}

// Moves y to an optimum of the leading levels near it. This is the first
// optimum of a working set that violates no bound. If a level is deficient,
// that working set must have no large negative multiplier either. Few rows have
// a positive multiplier there, so that rows with a negative one are removed
// together.
bool ParametricSearch::FindNearest(const Hierarchy& hierarchy, int limit,
                                   Budget* budget, WorkingSetProblem* problem,
                                   Sides* side) {
  const int num_levels = problem->num_leading();
  removals_.Reset(hierarchy);
  center_ = y_;
  for (Change last;;) {
    if (!budget->Take(limit, problem->work()) ||
        !problem->SolveLeadingWithin(hierarchy, *side, budget)) {
      return false;
    }
    problem->Approach(center_);
    const Blocking blocking =
        FindBlocking(hierarchy, *problem, num_levels, last, *side);
    const bool blocks = blocking.side != Side::kNone;
    if (blocks || !problem->meets_leading()) {
      problem->FindMultipliersOfApproach(center_);
      if (RemoveNegative(*problem, num_levels + 1, last, side)) {
        last = {};
        continue;
      }
    }
    StepTo(problem->y(), blocking.time);
    if (!blocks) return true;
    last = Add(blocking, side);
    // Where one row blocks, others are likely to block next, also those that
    // have been removed together.
    if (AddAhead(hierarchy, *problem, num_levels, last, true, side)) last = {};
  }
}

// Removes rows with a negative multiplier: all where it is that of a level, and
// of those where it is that of the distance, the ones with at least
// kLargeMultiplier of the most negative one. But rows that have been removed
// before in this search are only removed if there are no others, and then one
// by one: together, they would be added and removed again and again. Returns
// whether there was one.
bool ParametricSearch::RemoveNegative(const WorkingSetProblem& problem,
                                      int size, const Change& last,
                                      Sides* side) {
  bool any = false;
  double most_negative = 0;
  // The row that is removed alone, and its multiplier: the first level that has
  // one counts.
  RowIndex alone;
  int first_level = size;
  double least = 0;
  for (const bool removes : {false, true}) {
    for (int a = 0; a < problem.leading().num_rows(); ++a) {
      if (!MayRemove(problem, size, last, *side, a)) continue;
      const RowIndex row = {problem.row(a).level, problem.row(a).index};
      int level = 0;
      while (level < size - 1 && end_[level] == 0) ++level;
      const double multiplier = end_[level];
      const bool is_of_level = level < size - 1;
      if (!removals_.HasAllRemovals(row)) {
        if (level < first_level ||
            (level == first_level && multiplier < least)) {
          alone = row;
          first_level = level;
          least = multiplier;
        }
      } else if (!removes) {
        if (!is_of_level) most_negative = std::min(most_negative, multiplier);
      } else if (is_of_level ||
                 multiplier <= kLargeMultiplier * most_negative) {
        (void)Remove(row, side);
        any = true;
      }
    }
  }
  if (!any && alone.level >= 0) {
    (void)Remove(alone, side);
    any = true;
  }
  return any;
}

}  // namespace poise
