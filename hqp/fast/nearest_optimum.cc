// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// ParametricSearch: the move to a nearby point that meets all leading levels but the
// last.
#include <algorithm>

#include "poise/hqp/fast/parametric_search.h"

namespace poise {

bool ParametricSearch::MeetLevelsBeforeLast(const Hierarchy& hierarchy,
                                            int limit, Budget* budget,
                                            WorkingSetProblem* problem,
                                            Sides* side) {
  const int leading = problem->num_leading();
  // The last solve spent its budget here. The path must advance as well.
  if (leading < 2 || skips_near_) return true;
  removals_.Reset(hierarchy);
  problem->Approach(y_, leading - 1);
  if (FindBlocking(hierarchy, *problem, leading - 1, {}, *side).side ==
      Side::kNone) {
    y_ = problem->y();
    return true;
  }
  skips_near_ = true;
  center_ = y_;
  const int known = is_near_known_ ? leading - 1 : 0;
  std::copy(side->begin() + known, side->end(), near_side_.begin() + known);
  FitToBounds(hierarchy, &near_side_);
  is_near_known_ = true;
  problem->UseLeading(leading - 1);
  if (!FindNearest(hierarchy, limit, budget, problem, &near_side_) ||
      !budget->Take(limit, problem->work())) {
    Pause(*side);
    *side = near_side_;
    return false;
  }
  problem->UseLeading(leading);
  problem->SolveLeading(hierarchy, *side);
  return true;
}

// Moves y to the optimum of the leading levels that is closest to center_. There, few
// rows have a positive multiplier, so that rows with a negative one are removed
// together.
bool ParametricSearch::FindNearest(const Hierarchy& hierarchy, int limit,
                                   Budget* budget, WorkingSetProblem* problem,
                                   Sides* side) {
  const int num_levels = problem->num_leading();
  for (Change last;;) {
    if (!budget->Take(limit, problem->work())) return false;
    problem->SolveLeading(hierarchy, *side);
    problem->Approach(center_);
    problem->FindMultipliersOfApproach(center_);
    if (RemoveNegative(*problem, num_levels + 1, last, side)) {
      last = {};
      continue;
    }
    const Blocking blocking =
        FindBlocking(hierarchy, *problem, num_levels, last, *side);
    StepTo(problem->y(), blocking.time);
    if (blocking.side == Side::kNone) return true;
    last = Add(blocking, side);
    // Where one row blocks, others are likely to block next, also those that have been
    // removed together.
    if (AddAhead(hierarchy, *problem, num_levels, last, true, side)) last = {};
  }
}

// Removes all rows with a negative multiplier. Returns whether there was one.
bool ParametricSearch::RemoveNegative(const WorkingSetProblem& problem,
                                      int size, const Change& last,
                                      Sides* side) {
  bool any = false;
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    if (!MayRemove(problem, size, last, *side, a)) continue;
    (void)Remove({problem.row(a).level, problem.row(a).index}, side);
    any = true;
  }
  return any;
}

}  // namespace poise
