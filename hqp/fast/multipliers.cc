// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/multipliers.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/lexicographic_factorization.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/hqp/tolerances.h"

namespace poise {
namespace {

double Sign(Side side) { return static_cast<double>(side); }

}  // namespace

MultiplierWriter::MultiplierWriter(int num_variables)
    : n_(num_variables), remainder_(num_variables) {}

void MultiplierWriter::Write(const Hierarchy& hierarchy,
                             const std::vector<std::vector<Side>>& side,
                             WorkingSetProblem* problem, Solution* solution) {
  std::copy(problem->y().begin(), problem->y().end(), solution->y.data());
  norm_y_ = solution->y.norm();
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    EvaluateLevel(hierarchy, level, solution);
    for (int i = 0, rows = hierarchy.num_inequalities(level); i < rows; ++i) {
      Side& active = solution->levels[level].active[i];
      active = side[level][i];
      // A row with lower = upper is active at the side that is violated.
      if (hierarchy.lower(level)[i] == hierarchy.upper(level)[i]) {
        active = hierarchy.C(level).row(i).dot(solution->y) <
                         hierarchy.lower(level)[i]
                     ? Side::kLower
                     : Side::kUpper;
      }
    }
  }
  WriteMultipliers(*problem, solution);
  for (int level = problem->num_leading() + 1; level < problem->num_levels();
       ++level) {
    WriteDiagonalMultipliers(hierarchy, level, *problem, solution);
  }
  for (int level = 1; level < problem->num_levels(); ++level) {
    LevelSolution& of = solution->levels[level];
    of.traded_level = problem->FindTradeOff(level, of.trade_off.data());
  }
  MakeNonnegative(hierarchy, *problem, solution);
  if (finds_nullity) {
    WriteNullity(hierarchy, problem, solution);
  } else {
    for (LevelSolution& level : solution->levels) level.nullity = -1;
  }
}

bool MultiplierWriter::IsViolated(const WorkingSetProblem::Row& row,
                                  const Solution& solution) const {
  return solution.levels[row.level].slack[row.index] >
         tolerances::kAtBound * (row.norm * norm_y_ + std::abs(row.bound));
}

void MultiplierWriter::WriteMultipliers(const WorkingSetProblem& problem,
                                        Solution* solution) {
  for (int level = 1; level < problem.num_levels(); ++level) {
    const WorkingSetProblem::Multipliers& from = problem.multipliers(level);
    if (!from.any) continue;
    const int rows = level < problem.num_leading()
                         ? problem.leading().first_row(level)
                         : problem.leading().num_rows();
    for (int a = 0; a < rows; ++a) {
      const WorkingSetProblem::Row& row = problem.row(a);
      LevelMultipliers& to = solution->levels[level].multipliers[row.level];
      (row.is_inequality ? to.inequality : to.equality)[row.index] =
          from.nu[a] / row.norm;
    }
  }
}

// The stationarity of a diagonal level has a remainder on variables that
// earlier diagonal levels have fixed. The multiplier of one row of these levels
// cancels it.
void MultiplierWriter::WriteDiagonalMultipliers(
    const Hierarchy& hierarchy, int level, const WorkingSetProblem& problem,
    Solution* solution) {
  const int num_leading = problem.num_leading();
  const auto fixed_by = [&](int variable) {
    return problem.diagonal().level(variable) + num_leading;
  };
  const WorkingSetProblem::Multipliers& of = problem.multipliers(level);
  std::fill(remainder_.begin(), remainder_.end(), 0);
  if (of.any) std::copy(of.left.begin(), of.left.end(), remainder_.begin());
  for (int i = 0, rows = hierarchy.num_equalities(level); i < rows; ++i) {
    const int j = problem.selected(level, i);
    if (problem.IsLeftOut(level, i) || fixed_by(j) >= level) continue;
    remainder_[j] += hierarchy.weight(level)[i] * hierarchy.B(level)(i, j) *
                     solution->levels[level].equality_residual[i];
  }
  for (int above = num_leading; above < level; ++above) {
    Eigen::VectorXd& to = solution->levels[level].multipliers[above].equality;
    for (int i = 0, rows = hierarchy.num_equalities(above); i < rows; ++i) {
      const int j = problem.selected(above, i);
      if (remainder_[j] == 0 || fixed_by(j) != above ||
          hierarchy.weight(above)[i] == 0 || problem.IsLeftOut(above, i)) {
        continue;
      }
      to[i] = -remainder_[j] / hierarchy.B(above)(i, j);
      remainder_[j] = 0;
    }
  }
}

// Returns the coefficient of row a in the stationarity equation of a level. On
// the row's own level this is its weighted residual, which counts as zero for
// the certificate if it is small.
double MultiplierWriter::Weight(const WorkingSetProblem& problem,
                                const Solution& solution, int a,
                                int level) const {
  const WorkingSetProblem::Row& row = problem.row(a);
  if (level == row.level) {
    return problem.leading().is_deficient(level)
               ? problem.multipliers(level).nu[a] / row.norm
               : 0;
  }
  const LevelMultipliers& of = solution.levels[level].multipliers[row.level];
  return (row.is_inequality ? of.inequality : of.equality)[row.index];
}

// Returns the rounding of a coefficient in the stationarity equation of a
// level. Rows are scaled to unit length, so that their coefficients can be
// compared.
double MultiplierWriter::Rounding(const WorkingSetProblem& problem,
                                  const Solution& solution, int level) const {
  double largest = 0;
  for (int a = 0; a < problem.leading().num_rows(); ++a) {
    const WorkingSetProblem::Row& row = problem.row(a);
    if (row.level > level) continue;
    largest = std::max(
        largest, row.norm * std::abs(Weight(problem, solution, a, level)));
  }
  return tolerances::kZeroMultiplier * largest;
}

// Returns the first level before `level` whose stationarity equation has a
// positive coefficient of row a, and this coefficient. Returns {level, 0} if
// there is none.
std::pair<int, double> MultiplierWriter::FirstPositiveMultiplier(
    const WorkingSetProblem& problem, const Solution& solution, int a,
    int level, Side side) const {
  const WorkingSetProblem::Row& row = problem.row(a);
  for (int l = row.level; l < level; ++l) {
    const double weight = Sign(side) * Weight(problem, solution, a, l);
    if (weight > 0 && weight * row.norm > Rounding(problem, solution, l)) {
      return {l, weight};
    }
  }
  return {level, 0};
}

// Makes multipliers nonnegative. A multiplier may be negative if that of an
// earlier level is positive. Adding a multiple of the earlier level's
// stationarity equation, which sums to zero, makes it zero.
void MultiplierWriter::MakeNonnegative(const Hierarchy& hierarchy,
                                       const WorkingSetProblem& problem,
                                       Solution* solution) {
  for (int level = 1; level < problem.num_levels(); ++level) {
    if (!problem.multipliers(level).any) continue;
    const LevelSolution& of = solution->levels[level];
    const int rows = level < problem.num_leading()
                         ? problem.leading().first_row(level)
                         : problem.leading().num_rows();
    for (int a = 0; a < rows; ++a) {
      const WorkingSetProblem::Row& row = problem.row(a);
      if (!row.is_inequality || IsViolated(row, *solution) ||
          hierarchy.lower(row.level)[row.index] ==
              hierarchy.upper(row.level)[row.index]) {
        continue;
      }
      const Side side = solution->levels[row.level].active[row.index];
      const double mu =
          Sign(side) * of.multipliers[row.level].inequality[row.index];
      if (mu >= 0 ||
          problem.Multiplier(a, level, side, tolerances::kZeroMultiplier) == 0)
        continue;
      const auto [first, multiplier] =
          FirstPositiveMultiplier(problem, *solution, a, level, side);
      if (multiplier == 0) continue;
      AddEquation(hierarchy, first, -mu / multiplier, problem, level, solution);
    }
  }
}

// Adds a multiple of the stationarity equation of level `from` to the
// multipliers of level `to`.
void MultiplierWriter::AddEquation(const Hierarchy& hierarchy, int from,
                                   double factor,
                                   const WorkingSetProblem& problem, int to,
                                   Solution* solution) {
  std::vector<LevelMultipliers>& sum = solution->levels[to].multipliers;
  if (from < problem.num_leading()) {
    const WorkingSetProblem::Multipliers& of = problem.multipliers(from);
    for (int a = of.any ? problem.leading().first_row(from) : 0;
         a < problem.leading().end_row(from); ++a) {
      const WorkingSetProblem::Row& row = problem.row(a);
      LevelMultipliers& at = sum[row.level];
      (row.is_inequality ? at.inequality : at.equality)[row.index] +=
          factor * of.nu[a] / row.norm;
    }
  } else {
    AddOwnMultipliers(hierarchy, from, factor, problem, *solution,
                      &sum[from].equality);
  }
  for (int above = 0; above < from; ++above) {
    const LevelMultipliers& of = solution->levels[from].multipliers[above];
    sum[above].equality += factor * of.equality;
    sum[above].inequality += factor * of.inequality;
  }
}

// Adds the coefficients of a diagonal level's own rows in its stationarity
// equation. On its own variables they are computed from the other terms of the
// equation, because the residual of a large-weight row has few correct digits.
void MultiplierWriter::AddOwnMultipliers(const Hierarchy& hierarchy, int level,
                                         double factor,
                                         const WorkingSetProblem& problem,
                                         const Solution& solution,
                                         Eigen::VectorXd* sum) {
  const LevelSolution& of = solution.levels[level];
  auto left = Eigen::VectorXd::Map(remainder_.data(), n_);
  left.setZero();
  for (int above = 0; above < level; ++above) {
    const auto B = hierarchy.B(above), C = hierarchy.C(above);
    for (int i = 0; i < B.rows(); ++i) {
      left += of.multipliers[above].equality[i] * B.row(i);
    }
    for (int i = 0; i < C.rows(); ++i) {
      left += of.multipliers[above].inequality[i] * C.row(i);
    }
  }
  for (int i = 0, rows = hierarchy.num_equalities(level); i < rows; ++i) {
    if (hierarchy.weight(level)[i] == 0 || problem.IsLeftOut(level, i))
      continue;
    const int j = problem.selected(level, i);
    const double scale = hierarchy.B(level)(i, j);
    if (problem.diagonal().level(j) + problem.num_leading() == level) {
      (*sum)[i] -= factor * left[j] / scale;
      left[j] = 0;
    } else {
      (*sum)[i] +=
          factor * hierarchy.weight(level)[i] * of.equality_residual[i];
    }
  }
}

// Counts equalities and violated rows only. Active rows at their bounds are
// left out, so the remaining rows must be factored again, in the memory of the
// factorisation of the working set. If the rows are well conditioned, each
// counts for one, and only the diagonal levels need a factorisation.
void MultiplierWriter::WriteNullity(const Hierarchy& hierarchy,
                                    WorkingSetProblem* problem,
                                    Solution* solution) {
  LexicographicFactorization& equalities = problem->ReleaseLeading();
  const bool is_quick = equalities.is_well_conditioned();
  const int num_rows = equalities.num_rows();
  bool all_count = true;
  equalities.Truncate(0);
  for (int level = 0; level < problem->num_leading(); ++level) {
    for (int a = 0; a < num_rows; ++a) {
      const WorkingSetProblem::Row& row = problem->row(a);
      if (row.level != level) continue;
      if (row.is_inequality && !IsViolated(row, *solution)) {
        all_count = false;
        continue;
      }
      const double* from = row.is_inequality
                               ? hierarchy.C(level).row(row.index).data()
                               : hierarchy.B(level).row(row.index).data();
      double* to = equalities.row(equalities.AddRow(0, 1));
      for (int j = 0; j < n_; ++j) to[j] = from[j] / row.norm;
    }
    if (!is_quick) equalities.FactorLevel();
    solution->levels[level].nullity =
        n_ - (is_quick ? equalities.num_rows() : equalities.rank());
  }
  const int num_levels = problem->num_levels();
  for (int level = num_levels; level < hierarchy.num_levels(); ++level) {
    solution->levels[level].nullity = -1;  // Not solved.
  }
  if (problem->num_leading() == num_levels) return;
  DiagonalLevels& diagonal = problem->diagonal();
  if (all_count) {
    // The diagonal levels are tied to the same rows already.
  } else if (is_quick) {
    diagonal.TieRows(equalities.row(0), equalities.stride(),
                     equalities.num_rows());
  } else {
    diagonal.Tie(equalities);
  }
  for (int level = problem->num_leading(); level < num_levels; ++level) {
    solution->levels[level].nullity =
        diagonal.Nullity(level - problem->num_leading());
  }
}

}  // namespace poise
