// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// ParametricSearch: a blocking row that depends on rows of the working set.
#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/infinitesimals.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/math/rank.h"

namespace poise {

// Returns the row that a blocking row replaces, or no row. The blocking row r
// depends on rows of the working set, r = sum_a f_a r_a. If it is added with
// the multiplier t, the multiplier of row a becomes m_a - t f_a, where f_a
// counts towards the bounds. The first one that becomes zero is removed. That
// takes one iteration instead of two, and the rows of the working set stay
// independent (Ferreau, Bock, Diehl 2008, section 3.3). The row is added
// without an exchange if that t is not infinitesimal on all levels of these
// rows, or if one of the levels is deficient: the factors of its rows are not
// unique. pre: y and the multipliers are those at the time when the row blocks.
RowIndex ParametricSearch::Exchange(const Hierarchy& hierarchy,
                                    const Blocking& added, int size,
                                    const Change& last, const Sides& side,
                                    WorkingSetProblem* problem) {
  const int rows = problem->leading().num_rows();
  const double* factors = FindFactors(hierarchy, added, side, problem);
  if (factors == nullptr) return {};
  std::vector<double>& least = removal_time_;  // The multiplier t.
  RowIndex removed;
  double factor = 0;             // That of `removed`.
  int lowest = added.row.level;  // The last level of a row with a factor.
  for (int a = 0; a < rows; ++a) {
    if (factors[a] == 0) continue;
    const RowIndex index = {problem->row(a).level, problem->row(a).index};
    if (problem->leading().is_deficient(index.level)) return {};
    lowest = std::max(lowest, index.level);
    if (factors[a] <= tolerances::kZeroFactor ||
        !problem->row(a).is_inequality || removals_.IsFrozen(index)) {
      continue;
    }
    const double* start = start_.At(index.level, index.row);
    const bool is_positive = infinitesimals::Sign(start, size) > 0;
    for (int k = 0; k < size; ++k) {
      scratch_[k] = is_positive ? start[k] / factors[a] : 0;
    }
    // If two multipliers vanish together, the one with the larger factor is
    // taken.
    if (removed.level < 0 ||
        infinitesimals::IsLess(scratch_.data(), least.data(), size) ||
        (factors[a] > factor &&
         !infinitesimals::IsLess(least.data(), scratch_.data(), size))) {
      removed = index;
      least = scratch_;
      factor = factors[a];
    }
  }
  if (removed.level < 0 || removed == last.added ||
      !removals_.MayChange(removed) ||
      infinitesimals::Sign(least.data(), lowest + 1) != 0) {
    return {};
  }
  for (int a = 0; a < rows; ++a) {
    const RowIndex index = {problem->row(a).level, problem->row(a).index};
    if (factors[a] == 0 || !problem->row(a).is_inequality) continue;
    double* start = start_.At(index.level, index.row);
    for (int k = 0; k < size; ++k) {
      const double term = factors[a] * least[k], rest = start[k] - term;
      const bool is_rounding =
          std::abs(rest) <= infinitesimals::kRounding * std::abs(term);
      start[k] = is_rounding ? 0 : rest;
    }
  }
  start_.Remove(removed.level, removed.row);
  std::copy_n(least.begin(), size, start_.At(added.row.level, added.row.row));
  return removed;
}

// Finds the factors f_a, by row of the working set: r = sum_a f_a r_a for a
// blocking row r, where all rows have unit length and count towards their
// bounds. Factors that are rounding are zero. Returns null if the sum differs
// from r by more than rounding of its terms: an exchange would then let y
// violate the row that is removed.
const double* ParametricSearch::FindFactors(const Hierarchy& hierarchy,
                                            const Blocking& added,
                                            const Sides& side,
                                            WorkingSetProblem* problem) const {
  const double* row = hierarchy.C(added.row.level).data() + added.row.row * n_;
  const auto [factors, remainder] = problem->FindCombination(row);
  if (factors == nullptr) return nullptr;
  const int rows = problem->leading().num_rows();
  const double norm = std::sqrt(kernels::SquaredNorm(row, n_));
  const double largest = kernels::Largest(factors, rows);
  if (remainder > kRankTolerance * std::max(norm, largest)) return nullptr;
  const double rounding = tolerances::kZeroMultiplier * largest;
  for (int a = 0; a < rows; ++a) {
    const WorkingSetProblem::Row& of = problem->row(a);
    const bool is_same_side =
        !of.is_inequality || side[of.level][of.index] == added.side;
    const bool is_zero = std::abs(factors[a]) <= rounding;
    factors[a] *= is_zero ? 0 : (is_same_side ? 1 : -1) / norm;
  }
  return factors;
}

}  // namespace poise
