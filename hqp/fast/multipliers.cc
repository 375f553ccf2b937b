// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/fast/multipliers.h"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

// A row violated by less than this, relative to what it is added up from, is at
// its bound; see cascade.cc.
constexpr double kAtBound = 1e-9;

double Sign(Side side) { return static_cast<double>(side); }

}  // namespace

Reporter::Reporter(int num_variables,
                   const std::vector<LevelCapacity>& capacity)
    : n_(num_variables),
      equalities_(num_variables, NumRows(capacity),
                  static_cast<int>(capacity.size())),
      left_(num_variables) {}

void Reporter::Report(const Hierarchy& hierarchy,
                      const std::vector<std::vector<Side>>& side,
                      double tolerance, ActiveProblem* problem,
                      Solution* solution) {
  std::copy(problem->y().begin(), problem->y().end(), solution->y.data());
  norm_y_ = solution->y.norm();
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    EvaluateLevel(hierarchy, level, solution);
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      Side& active = solution->levels[level].active[i];
      active = side[level][i];
      // Of a row with lower = upper, the one that is violated, if any.
      if (hierarchy.lower(level)[i] == hierarchy.upper(level)[i]) {
        active = hierarchy.C(level).row(i).dot(solution->y) <
                         hierarchy.lower(level)[i]
                     ? Side::kLower
                     : Side::kUpper;
      }
    }
  }
  ReportMultipliers(*problem, solution);
  for (int level = problem->num_head() + 1; level < problem->num_levels();
       ++level) {
    ReportTailMultipliers(hierarchy, level, *problem, solution);
  }
  MakeNonnegative(hierarchy, tolerance, *problem, solution);
  ReportNullity(hierarchy, problem, solution);
}

bool Reporter::IsViolated(const ActiveProblem::Row& row,
                          const Solution& solution) const {
  return solution.levels[row.level].slack[row.index] >
         kAtBound * (row.norm * norm_y_ + std::abs(row.bound));
}

void Reporter::ReportMultipliers(const ActiveProblem& problem,
                                 Solution* solution) {
  for (int level = 1; level < problem.num_levels(); ++level) {
    const ActiveProblem::Multipliers& from = problem.multipliers(level);
    if (!from.any) continue;
    const int rows = level < problem.num_head()
                         ? problem.head().first_row(level)
                         : problem.head().num_rows();
    for (int a = 0; a < rows; ++a) {
      const ActiveProblem::Row& row = problem.row(a);
      LevelMultipliers& to = solution->levels[level].multipliers[row.level];
      (row.is_inequality ? to.inequality : to.equality)[row.index] =
          from.nu[a] / row.norm;
    }
  }
}

// A level of the tail leaves something on variables that levels of the tail
// before it have fixed: one row of these cancels it.
void Reporter::ReportTailMultipliers(const Hierarchy& hierarchy, int level,
                                     const ActiveProblem& problem,
                                     Solution* solution) {
  const int num_head = problem.num_head();
  const auto fixed_by = [&](int variable) {
    return problem.tail().level(variable) + num_head;
  };
  const ActiveProblem::Multipliers& of = problem.multipliers(level);
  std::fill(left_.begin(), left_.end(), 0);
  if (of.any) std::copy(of.left.begin(), of.left.end(), left_.begin());
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const int j = problem.selected(level, i);
    if (fixed_by(j) >= level) continue;
    left_[j] += hierarchy.weight(level)[i] * hierarchy.B(level)(i, j) *
                solution->levels[level].equality_residual[i];
  }
  for (int above = num_head; above < level; ++above) {
    Eigen::VectorXd& to = solution->levels[level].multipliers[above].equality;
    for (int i = 0; i < hierarchy.num_equalities(above); ++i) {
      const int j = problem.selected(above, i);
      if (left_[j] == 0 || fixed_by(j) != above ||
          hierarchy.weight(above)[i] == 0 || hierarchy.B(above)(i, j) == 0) {
        continue;
      }
      to[i] = -left_[j] / hierarchy.B(above)(i, j);
      left_[j] = 0;
    }
  }
}

// What row a weighs in the equation of a level: its own, where it is violated
// if so little that it counts as met, or one below.
double Reporter::Weight(const ActiveProblem& problem, const Solution& solution,
                        int a, int level) const {
  const ActiveProblem::Row& row = problem.row(a);
  if (level == row.level) {
    return problem.head().is_deficient(level)
               ? problem.multipliers(level).nu[a] / row.norm
               : 0;
  }
  const LevelMultipliers& of = solution.levels[level].multipliers[row.level];
  return (row.is_inequality ? of.inequality : of.equality)[row.index];
}

// What weighs no more than this in the equation of a level is rounding's; of rows
// of unit length, so that they can be compared.
double Reporter::Rounding(const ActiveProblem& problem,
                          const Solution& solution, int level,
                          double tolerance) const {
  double largest = 0;
  for (int a = 0; a < problem.head().num_rows(); ++a) {
    const ActiveProblem::Row& row = problem.row(a);
    if (row.level > level) continue;
    largest = std::max(
        largest, row.norm * std::abs(Weight(problem, solution, a, level)));
  }
  return tolerance * largest;
}

// The first level before this one in whose equation row a weighs anything, and
// what it weighs there; 0 if there is none.
std::pair<int, double> Reporter::FirstHeldBack(const ActiveProblem& problem,
                                               const Solution& solution, int a,
                                               int level, Side side,
                                               double tolerance) const {
  const ActiveProblem::Row& row = problem.row(a);
  for (int l = row.level; l < level; ++l) {
    const double weight = Sign(side) * Weight(problem, solution, a, l);
    if (weight * row.norm > Rounding(problem, solution, l, tolerance)) {
      return {l, weight};
    }
  }
  return {level, 0};
}

// A multiplier may be negative where that of a level before is positive. A
// multiple of that level's own equation, which adds up to zero, makes it right.
void Reporter::MakeNonnegative(const Hierarchy& hierarchy, double tolerance,
                               const ActiveProblem& problem,
                               Solution* solution) {
  for (int level = 1; level < problem.num_levels(); ++level) {
    if (!problem.multipliers(level).any) continue;
    const LevelSolution& of = solution->levels[level];
    const int rows = level < problem.num_head()
                         ? problem.head().first_row(level)
                         : problem.head().num_rows();
    for (int a = 0; a < rows; ++a) {
      const ActiveProblem::Row& row = problem.row(a);
      if (!row.is_inequality || IsViolated(row, *solution) ||
          hierarchy.lower(row.level)[row.index] ==
              hierarchy.upper(row.level)[row.index]) {
        continue;
      }
      const Side side = solution->levels[row.level].active[row.index];
      const double mu =
          Sign(side) * of.multipliers[row.level].inequality[row.index];
      if (mu >= 0 || problem.Price(a, level, side, tolerance) == 0) continue;
      const auto [first, price] =
          FirstHeldBack(problem, *solution, a, level, side, tolerance);
      if (price == 0) continue;
      AddEquation(hierarchy, first, -mu / price, problem, level, solution);
    }
  }
}

// Adds to the multipliers of `to` a multiple of the equation of the level `from`.
void Reporter::AddEquation(const Hierarchy& hierarchy, int from, double factor,
                           const ActiveProblem& problem, int to,
                           Solution* solution) {
  std::vector<LevelMultipliers>& sum = solution->levels[to].multipliers;
  if (from < problem.num_head()) {
    const ActiveProblem::Multipliers& of = problem.multipliers(from);
    for (int a = of.any ? problem.head().first_row(from) : 0;
         a < problem.head().end_row(from); ++a) {
      const ActiveProblem::Row& row = problem.row(a);
      LevelMultipliers& at = sum[row.level];
      (row.is_inequality ? at.inequality : at.equality)[row.index] +=
          factor * of.nu[a] / row.norm;
    }
  } else {
    AddOwn(hierarchy, from, factor, problem, *solution, &sum[from].equality);
  }
  for (int above = 0; above < from; ++above) {
    const LevelMultipliers& of = solution->levels[from].multipliers[above];
    sum[above].equality += factor * of.equality;
    sum[above].inequality += factor * of.inequality;
  }
}

// What the rows of a level of the tail weigh in its equation. On its own variables
// that is what cancels the others: of what heavy rows lack rounding leaves few
// digits.
void Reporter::AddOwn(const Hierarchy& hierarchy, int level, double factor,
                      const ActiveProblem& problem, const Solution& solution,
                      Eigen::VectorXd* sum) {
  const LevelSolution& of = solution.levels[level];
  auto left = Eigen::VectorXd::Map(left_.data(), n_);
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
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    const int j = problem.selected(level, i);
    const double scale = hierarchy.B(level)(i, j);
    if (hierarchy.weight(level)[i] == 0 || scale == 0) continue;
    if (problem.tail().level(j) + problem.num_head() == level) {
      (*sum)[i] -= factor * left[j] / scale;
      left[j] = 0;
    } else {
      (*sum)[i] +=
          factor * hierarchy.weight(level)[i] * of.equality_residual[i];
    }
  }
}

// Counts only equalities and violated rows. With rows at their bounds that are
// left out, it takes a factorisation of what is left; but of independent rows
// each counts for one, and only the tail must be asked.
void Reporter::ReportNullity(const Hierarchy& hierarchy, ActiveProblem* problem,
                             Solution* solution) {
  const RowStack& head = problem->head();
  const bool is_quick = head.is_well_conditioned();
  bool all_count = true;
  equalities_.Truncate(0);
  for (int level = 0; level < problem->num_head(); ++level) {
    for (int a = 0; a < head.num_rows(); ++a) {
      const ActiveProblem::Row& row = problem->row(a);
      if (row.level != level) continue;
      if (row.is_inequality && !IsViolated(row, *solution)) {
        all_count = false;
        continue;
      }
      const double* from = row.is_inequality
                               ? hierarchy.C(level).row(row.index).data()
                               : hierarchy.B(level).row(row.index).data();
      double* to = equalities_.row(equalities_.AddRow(0, 1));
      for (int j = 0; j < n_; ++j) to[j] = from[j] / row.norm;
    }
    if (!is_quick) equalities_.FactorLevel();
    solution->levels[level].nullity =
        n_ - (is_quick ? equalities_.num_rows() : equalities_.rank());
  }
  SelectionTail& tail = problem->tail();
  if (all_count) {
    // As it is tied.
  } else if (is_quick) {
    tail.TieRows(equalities_.row(0), equalities_.stride(),
                 equalities_.num_rows());
  } else {
    tail.Tie(equalities_);
  }
  for (int level = problem->num_head(); level < problem->num_levels();
       ++level) {
    solution->levels[level].nullity = tail.Nullity(level - problem->num_head());
  }
}

}  // namespace poise
