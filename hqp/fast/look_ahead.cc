// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// ParametricSearch: changes of the working set before their times.
#include <array>
#include <utility>

#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/fast/tolerances.h"

namespace poise {
namespace {

// Most rows that are added ahead in one iteration. Of 2, 3, 4 and 6, none is
// best for all recorded sequences (docs/notebook/2026-11-28-groups.md).
constexpr int kMaxAhead = 3;

// Most rows that are removed ahead in one iteration: long runs remove many.
// Chosen: 6, 8 and 12 differ little (docs/notebook/2026-11-29-updates.md).
constexpr int kMaxRemovedAhead = 8;

// After so many iterations in a row that flip a row, the path flips rows ahead,
// up to kMaxFlippedAhead. Chosen: of runs of 1, 2, 3 and 4 and of 1, 2, 3 and 7
// rows, these lose momentum in the fewest ticks
// (docs/notebook/2026-11-29-flips.md).
constexpr int kFlipRun = 3, kMaxFlippedAhead = 3;

}  // namespace

// Changes further rows after a long run of iterations that all added, removed
// or flipped rows.
void ParametricSearch::LookAhead(const Hierarchy& hierarchy,
                                 const WorkingSetProblem& problem,
                                 const Run& run, Change* last, Sides* side) {
  const int num_levels = problem.num_levels(), size = num_levels + 1;
  bool any = false;
  if (run.flips >= kFlipRun) {
    any = FlipAhead(hierarchy, problem, size, *last, side);
  } else if (run.length >= Run::kLong) {
    any = run.adds
              ? AddAhead(hierarchy, problem, num_levels, *last, false, side)
              : RemoveAhead(problem, size, *last, side);
  }
  if (!any) return;
  // Rows that change ahead may require that the last change is undone.
  const bool is_flip = last->is_flip;
  *last = {};
  last->is_flip = is_flip;
}

// Adds those rows of one variable of the first `num_levels` levels that block
// next, up to kMaxAhead, but none that has been removed on this path, unless
// `again`. Returns whether there was one. When a robot reaches its limits, many
// such rows are added one after the other; most are independent of each other,
// and a wrong one gets a negative multiplier and is removed.
bool ParametricSearch::AddAhead(const Hierarchy& hierarchy,
                                const WorkingSetProblem& problem,
                                int num_levels, const Change& last, bool again,
                                Sides* side) {
  const double noise = Noise(problem);
  std::array<Blocking, kMaxAhead> next;  // In the order of their times.
  for (int level = 0; level < num_levels; ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      const Span span = hierarchy.C_span(level)[i];
      if (span.size != 1 || (*side)[level][i] != Side::kNone) continue;
      const double value =
          hierarchy.C(level)(i, span.first) * problem.y()[span.first];
      if ((value <= upper[i] && value >= lower[i]) ||
          (!again && !removals_.HasAllRemovals({level, i}))) {
        continue;
      }
      Blocking row =
          FindTime(hierarchy, problem, {level, i}, value, noise, last);
      for (Blocking& earlier : next) {
        if (row.time < earlier.time) std::swap(row, earlier);
      }
    }
  }
  for (const Blocking& row : next) {
    if (row.side != Side::kNone) (void)Add(row, side);
  }
  return next[0].side != Side::kNone;
}

// Removes those rows whose multipliers become negative next, up to
// kMaxRemovedAhead, and none after one that has been removed on this path. From
// then on, their multipliers count as zero. Returns whether there was one. A
// row that should have stayed blocks at once and is added again.
bool ParametricSearch::RemoveAhead(const WorkingSetProblem& problem, int size,
                                   const Change& last, Sides* side) {
  bool any = false;
  for (int i = 0; i < kMaxRemovedAhead; ++i) {
    const RowIndex row = FindRemoval(problem, size, last, *side);
    if (row.level < 0 || !removals_.HasAllRemovals(row)) break;
    start_.Remove(row.level, row.row);
    (void)Remove(row, side);
    any = true;
  }
  return any;
}

// Flips those rows whose multipliers become negative next, up to
// kMaxFlippedAhead. Returns whether there was one.
bool ParametricSearch::FlipAhead(const Hierarchy& hierarchy,
                                 const WorkingSetProblem& problem, int size,
                                 const Change& last, Sides* side) {
  bool any = false;
  for (int i = 0; i < kMaxFlippedAhead; ++i) {
    const RowIndex row = FindRemoval(problem, size, last, *side);
    if (row.level < 0 || !MayFlip(hierarchy, row)) break;
    start_.Remove(row.level, row.row);
    (void)Flip(row, side);
    any = true;
  }
  return any;
}

// Returns whether a row can be flipped: it has one variable and two bounds, and
// this solve has neither removed nor flipped it before.
bool ParametricSearch::MayFlip(const Hierarchy& hierarchy, RowIndex row) const {
  return hierarchy.C_span(row.level)[row.row].size == 1 &&
         hierarchy.upper(row.level)[row.row] <= tolerances::kInfiniteBound &&
         hierarchy.lower(row.level)[row.row] >= -tolerances::kInfiniteBound &&
         removals_.HasAllRemovals(row);
}

// Moves a row to its other bound, with the multiplier zero. If the prediction
// is right, the row would be added there next. If not, its multiplier becomes
// negative, and the next iteration removes it.
ParametricSearch::Change ParametricSearch::Flip(RowIndex row, Sides* side) {
  removals_.CountRemoval(row);
  Side& at = (*side)[row.level][row.row];
  at = at == Side::kUpper ? Side::kLower : Side::kUpper;
  Change change;
  change.is_flip = true;
  return change;
}

}  // namespace poise
