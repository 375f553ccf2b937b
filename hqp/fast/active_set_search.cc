// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/fast/active_set_search.h"

#include <algorithm>
#include <cmath>

#include "hqp/fast/kernels.h"

namespace poise {
namespace {

constexpr double kTolerance = ActiveProblem::kTolerance;
constexpr double kNoPrice = ActiveProblem::kNoPrice;
constexpr double kRounding = ActiveProblem::kRounding;

// How often a row may leave on a level, or all at once: more than any search was
// seen to need, and few enough to end what rounding alone keeps going.
constexpr int kLeaves = 10;

// In place of that: an equality, for good.
constexpr int kKept = -1;

constexpr int kNone = -1;

// Of a row whose sides are one.
bool IsFixed(const Hierarchy& hierarchy, int level, int i) {
  return hierarchy.lower(level)[i] == hierarchy.upper(level)[i];
}

}  // namespace

Descent::Descent(int num_variables, const std::vector<LevelCapacity>& capacity)
    : n_(num_variables), y_(num_variables), step_(num_variables) {
  int most = 0;
  for (const LevelCapacity& level : capacity) {
    leaves_.emplace_back(level.inequalities, kLeaves);
    broken_.emplace_back(level.inequalities, Side::kNone);
    settled_.emplace_back(level.inequalities, Side::kNone);
    most = std::max(most, level.inequalities);
  }
  value_.resize(most);
  slope_.resize(most);
}

bool Descent::AllAtOnce(const Hierarchy& hierarchy, int limit, Budget* budget,
                        ActiveProblem* problem,
                        std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  if (!budget->Take(limit)) return false;
  together_ = true;
  problem->Plan(hierarchy, levels);
  problem->Solve(hierarchy, *side);
  if (!Start(hierarchy, problem, side)) return true;
  // What is best for the head comes first: steps there are cheaper.
  do {
    if (!budget->Take(limit)) return false;
    problem->SolveHead(hierarchy, *side);
    problem->Approach(y_);
  } while (Settle(hierarchy, problem->num_head() - 1, problem, side));
  problem->SolveTail();
  while (Settle(hierarchy, levels, problem, side)) {
    if (!budget->Take(limit)) return false;
    problem->Solve(hierarchy, *side);
  }
  return true;
}

int Descent::LevelByLevel(const Hierarchy& hierarchy, Budget* budget,
                          ActiveProblem* problem,
                          std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  together_ = false;
  std::fill(y_.begin(), y_.end(), 0);
  for (std::vector<Side>& level : settled_) {
    std::fill(level.begin(), level.end(), Side::kNone);
  }
  for (int level = 0; level <= levels; ++level) {
    // Of all that are optimal on this level, the one closest to y; of all that
    // are on every level, the smallest.
    problem->Plan(hierarchy, std::min(level + 1, levels),
                  level < levels ? y_.data() : nullptr);
    if (level < levels) Begin(hierarchy, level, side);
    bool has_changed = true;
    while (has_changed) {
      if (!budget->Take()) {
        Unwind(side);
        return level;
      }
      problem->Solve(hierarchy, *side);
      has_changed = Settle(hierarchy, level, problem, side);
    }
    if (level < levels) Keep(level, *problem, *side);
    settled_ = *side;
  }
  return levels + 1;
}

// Back to the rows that were active when the last level was done, but for those
// that have left: what they held, nothing holds.
void Descent::Unwind(std::vector<std::vector<Side>>* side) const {
  for (size_t level = 0; level < settled_.size(); ++level) {
    for (size_t i = 0; i < settled_[level].size(); ++i) {
      Side& at = (*side)[level][i];
      if (at != settled_[level][i]) at = Side::kNone;
    }
  }
}

// Begins all levels at once; `problem` is solved for the active rows. Returns
// whether these change; if not, that is the optimum.
bool Descent::Start(const Hierarchy& hierarchy, ActiveProblem* problem,
                    std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  for (int level = 0; level < levels; ++level) {
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      leaves_[level][i] = IsFixed(hierarchy, level, i) ? kKept : kLeaves;
    }
  }
  const int there = FindBroken(hierarchy, *problem, problem->y(), *side);
  if (there == 0) {
    y_ = problem->y();
    return Drop(levels, problem, side);
  }
  if (there <= FindBroken(hierarchy, *problem, y_, *side)) {
    y_ = problem->y();
    FindBroken(hierarchy, *problem, y_, *side);
  }
  for (int level = 0; level < levels; ++level) {
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      if (broken_[level][i] == Side::kNone) continue;
      (*side)[level][i] = broken_[level][i];
    }
  }
  return true;
}

// Finds the sides that y breaks, but for those that are active. Returns how
// many.
int Descent::FindBroken(const Hierarchy& hierarchy,
                        const ActiveProblem& problem,
                        const std::vector<double>& y,
                        const std::vector<std::vector<Side>>& side) {
  const double largest = kernels::Largest(y.data(), n_);
  const double rounding = kRounding * problem.Size();
  int count = 0;
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    kernels::Dots(hierarchy.C(level).data(), n_, rows, y.data(), n_,
                  value_.data());
    for (int i = 0; i < rows; ++i) {
      broken_[level][i] = Side::kNone;
      const double above = value_[i] - upper[i], below = lower[i] - value_[i];
      if ((above <= 0 && below <= 0) || leaves_[level][i] == kKept ||
          problem.norm(level, i) == 0) {
        continue;
      }
      const Side broken = above > 0 ? Side::kUpper : Side::kLower;
      const double bound = above > 0 ? upper[i] : lower[i];
      const double norm = problem.norm(level, i);
      const double noise =
          kTolerance * (norm * largest + std::abs(bound)) + rounding * norm;
      if (broken != side[level][i] && std::max(above, below) > noise) {
        broken_[level][i] = broken;
        ++count;
      }
    }
  }
  return count;
}

// The rows of a level that are violated are active to begin with.
void Descent::Begin(const Hierarchy& hierarchy, int level,
                    std::vector<std::vector<Side>>* side) {
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  const int rows = hierarchy.num_inequalities(level);
  kernels::Dots(hierarchy.C(level).data(), n_, rows, y_.data(), n_,
                value_.data());
  for (int i = 0; i < rows; ++i) {
    leaves_[level][i] = IsFixed(hierarchy, level, i) ? kKept : kLeaves;
    (*side)[level][i] = value_[i] > upper[i] || lower[i] == upper[i]
                            ? Side::kUpper
                        : value_[i] < lower[i] ? Side::kLower
                                               : Side::kNone;
  }
}

// Goes towards the solution of the problem; if it gets there, lets rows leave.
// Returns whether the active rows change; if not, the levels up to this one are
// at their optimum.
bool Descent::Settle(const Hierarchy& hierarchy, int level,
                     ActiveProblem* problem,
                     std::vector<std::vector<Side>>* side) {
  return Advance(hierarchy, *problem, side) || Drop(level, problem, side);
}

// Goes towards the solution of the problem as far as the other rows, and the
// other sides of active rows, allow. Returns whether a row is in the way, now
// active.
bool Descent::Advance(const Hierarchy& hierarchy, const ActiveProblem& problem,
                      std::vector<std::vector<Side>>* side) {
  for (int j = 0; j < n_; ++j) step_[j] = problem.y()[j] - y_[j];
  const double largest = kernels::Largest(step_.data(), n_);
  const double rounding =
      kRounding * (kernels::Largest(y_.data(), n_) + problem.Size());
  const double noise = kTolerance * largest + rounding;
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
      if ((*side)[level][i] == towards || leaves_[level][i] <= 0 ||
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
  if (!has_moved && blocking.level == left_.level &&
      blocking.row == left_.row) {
    // What leaves moves away from its bound: it was for rounding that it left.
    leaves_[blocking.level][blocking.row] = 0;
  }
  return true;
}

// Lets the rows go that are inside their own bound (the first ones of a descent
// in company of all that only the tail draws along: steps are dear there); or else
// the one that holds the levels up to this one back most. Returns whether one
// does.
bool Descent::Drop(int level, ActiveProblem* problem,
                   std::vector<std::vector<Side>>* side) {
  int leaving = kNone;
  double worst = 0;
  bool is_priced = false, any = false;
  left_ = {kNone, kNone};
  for (int a = 0; a < problem->head().num_rows(); ++a) {
    const ActiveProblem::Row& row = problem->row(a);
    if (!row.is_inequality || leaves_[row.level][row.index] <= 0) {
      continue;
    }
    if (!is_priced) problem->FindMultipliers(level + 1);
    is_priced = true;
    Side& at = (*side)[row.level][row.index];
    double price = 0;
    int l = row.level;
    while (l <= level && price == 0)
      price = problem->Price(a, l++, at, kNoPrice);
    if (price >= 0) continue;
    if (l == row.level + 1 || (together_ && l > problem->num_head())) {
      at = Side::kNone;
      --leaves_[row.level][row.index];
      any = true;
    } else if (price < worst) {
      leaving = a;
      worst = price;
    }
  }
  if (any) together_ = false;
  if (any || leaving == kNone) return any;
  const ActiveProblem::Row& row = problem->row(leaving);
  left_ = {row.level, row.index};
  (*side)[row.level][row.index] = Side::kNone;
  --leaves_[row.level][row.index];
  return true;
}

// What a level leaves violated stays so; what rounding held may leave again.
void Descent::Keep(int level, const ActiveProblem& problem,
                   const std::vector<std::vector<Side>>& side) {
  for (int a = 0; a < problem.head().num_rows(); ++a) {
    const ActiveProblem::Row& row = problem.row(a);
    if (!row.is_inequality) continue;
    int& leaves = leaves_[row.level][row.index];
    if (row.level == level &&
        problem.Price(a, level, side[level][row.index], kNoPrice) > 0) {
      leaves = kKept;
    }
    if (leaves != kKept) leaves = kLeaves;
  }
}

}  // namespace poise
