// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// WorkingSetProblem: updates of the leading levels after a change of the
// working set.
#include <algorithm>

#include "poise/hqp/fast/same_sides.h"
#include "poise/hqp/fast/working_set_problem.h"

namespace poise {

// Factors the levels from the first one that has changed. If this is before the
// first deficient one, single rows are removed and appended instead: all rows
// before the first deficient level are met, so their order does not matter. If
// rows only go to their other bounds, the levels are only solved again.
// Returns false if the first level must be factored again. If a row has been
// found to depend on others, this reduces `mergeable`, the largest number of
// levels that may be merged then.
bool WorkingSetProblem::Update(const Hierarchy& hierarchy,
                               const std::vector<std::vector<Side>>& side,
                               int* mergeable) {
  const int factored = leading_.num_levels();
  int met = NumMet(), same = 0;
  while (same < factored && AreSame(side[same], factored_[same])) ++same;
  if (same > met) {
    if (same < num_leading_) FactorFrom(hierarchy, side, same, met > 0);
    return true;
  }
  if (met == 0) return false;
  const int changes = NumChanges(side, met);
  if (same < met && changes == 0) {
    ChangeSides(hierarchy, side, same, met);
    return true;
  }
  if (IsFactoringFaster(hierarchy, side, met, leading_.rank(met - 1),
                        changes)) {
    return false;
  }
  leading_.Merge(met);
  for (int a = leading_.num_rows() - 1; a >= 0; --a) {
    const Row& row = rows_[a];
    if (!row.is_inequality ||
        side[row.level][row.index] == factored_[row.level][row.index]) {
      continue;
    }
    if (side[row.level][row.index] != Side::kNone) {
      SetSide(hierarchy, a, side[row.level][row.index]);
      continue;
    }
    factored_[row.level][row.index] = Side::kNone;
    RemoveRow(a);
  }
  if (!AppendAll(hierarchy, side, &met)) {
    *mergeable = std::min(*mergeable, met);
    return false;
  }
  leading_.SolveLast();
  FactorFrom(hierarchy, side, met, true);
  leading_.ForgetUnused();
  return true;
}

// Sets the target of the factored row a to another bound.
void WorkingSetProblem::SetSide(const Hierarchy& hierarchy, int a, Side side) {
  Row& row = rows_[a];
  row.bound = Bound(hierarchy, row.level, row.index, side);
  leading_.SetTarget(a, row.bound / row.norm);
  factored_[row.level][row.index] = side;
}

// Updates levels of which the first `met` have the same rows as before, some of
// them with another side from level `from` on. Their factors stay, so that they
// are only solved again. Later levels are factored again from the first one
// that has changed.
void WorkingSetProblem::ChangeSides(const Hierarchy& hierarchy,
                                    const std::vector<std::vector<Side>>& side,
                                    int from, int met) {
  for (int a = 0; a < leading_.num_rows(); ++a) {
    const Row& row = rows_[a];
    if (!row.is_inequality || row.level >= met) continue;
    const Side after = side[row.level][row.index];
    if (after != factored_[row.level][row.index]) SetSide(hierarchy, a, after);
  }
  int changed = met;
  while (changed < leading_.num_levels() &&
         AreSame(side[changed], factored_[changed])) {
    ++changed;
  }
  leading_.Truncate(changed);
  leading_.SolveFrom(from);
  if (changed < num_leading_) FactorFrom(hierarchy, side, changed, true);
}

// Returns the number of rows of the first `met` levels that must be removed or
// appended. A row that goes to its other bound only gets another target.
int WorkingSetProblem::NumChanges(const std::vector<std::vector<Side>>& side,
                                  int met) const {
  int changes = 0;
  for (int level = 0; level < met; ++level) {
    if (AreSame(side[level], factored_[level])) continue;
    for (size_t i = 0; i < side[level].size(); ++i) {
      const Side before = factored_[level][i], after = side[level][i];
      if (before == after) continue;
      changes += (before == Side::kNone) != (after == Side::kNone);
    }
  }
  return changes;
}

// Returns whether factoring the first `met` levels for a working set takes less
// work than removing `changes` rows from merged levels of this rank, or
// appending them. A change takes about one rotation for two of the rows that
// fix no variable, and a rotation takes four multiply-adds a column. The
// factorisation takes two for each pair of such rows.
bool WorkingSetProblem::IsFactoringFaster(
    const Hierarchy& hierarchy, const std::vector<std::vector<Side>>& side,
    int met, int rank, int changes) const {
  const FixedVariables& variables = leading_.variables();
  const int rows = rank - variables.size();
  if (changes <= rows / 2) return false;  // Few changes are always faster.
  int rows_after = 0, num_fixed = 0;
  for (int level = 0; level < met; ++level) {
    const auto count = [&](Span span) {
      (span.size == 1 ? num_fixed : rows_after) += 1;
    };
    for (int i = 0, end = hierarchy.num_equalities(level); i < end; ++i) {
      count(hierarchy.B_span(level)[i]);
    }
    for (int i = 0, end = hierarchy.num_inequalities(level); i < end; ++i) {
      if (side[level][i] != Side::kNone) count(hierarchy.C_span(level)[i]);
    }
  }
  const int columns_after = std::max(n_ - num_fixed, 0);
  const double of_changes = 2.0 * changes * std::max(rows, rows_after) *
                            std::max(variables.num_free(), columns_after);
  return of_changes > 1.0 * rows_after * rows_after * columns_after;
}

// Appends the new rows of the first `met` levels, which are merged. If a row
// depends on others, removes the levels that cannot be merged, and reduces
// `met`. Returns false if the remaining levels must be factored again.
bool WorkingSetProblem::AppendAll(const Hierarchy& hierarchy,
                                  const std::vector<std::vector<Side>>& side,
                                  int* met) {
  for (int level = 0; level < *met; ++level) {
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      if (side[level][i] == factored_[level][i] || norm(level, i) == 0) {
        continue;
      }
      while (!AppendInequality(hierarchy, level, i, side[level][i])) {
        // It depends on rows of this level and those before, or also of later
        // ones.
        *met = *met > level + 1 ? level + 1 : level;
        if (*met == 0 || !RemoveLevels(hierarchy, side, *met)) return false;
        if (*met == level) return true;
      }
      factored_[level][i] = side[level][i];
    }
  }
  return true;
}

bool WorkingSetProblem::AppendInequality(const Hierarchy& hierarchy, int level,
                                         int i, Side side) {
  const Row row = Inequality(hierarchy, level, i, side);
  const double* from = Original(hierarchy, row);
  if (row.span.size > 1) {
    AddRow(row, from, 1, LexicographicFactorization::kNoKey);
    return leading_.AppendRow();
  }
  rows_[leading_.AddRow(row.bound / row.norm, row.norm)] = row;
  const int variable = row.span.first;
  return leading_.AppendFixedVariable(variable, from[variable] / row.norm);
}

// Removes the rows of `level` and of later levels from the merged levels.
// Returns false, without a change, if factoring the others again takes less
// work.
bool WorkingSetProblem::RemoveLevels(const Hierarchy& hierarchy,
                                     const std::vector<std::vector<Side>>& side,
                                     int level) {
  const int rows = leading_.num_rows();
  const auto is_removed = [&](const Row& row) { return row.level >= level; };
  const auto changes = static_cast<int>(
      std::count_if(rows_.begin(), rows_.begin() + rows, is_removed));
  if (IsFactoringFaster(hierarchy, side, level, leading_.rank(), changes)) {
    return false;
  }
  for (int a = rows - 1; a >= 0; --a) {
    if (is_removed(rows_[a])) RemoveRow(a);
  }
  leading_.Unmerge(level);
  return true;
}

void WorkingSetProblem::RemoveRow(int a) {
  leading_.RemoveRow(a);
  rows_[a] = rows_[leading_.num_rows()];
}

}  // namespace poise
