// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/level_search.h"

#include <algorithm>
#include <cmath>

#include "hqp/kernels.h"

namespace poise {
namespace {

// A multiplier, a violation or a slope below this, relative to what it is added
// up from, is zero.
constexpr double kTolerance = 1e-11;

// What rounding leaves of an entry of a step, relative to the largest of y.
constexpr double kRounding = 1e-13;

// After so many steps of no length, the first row that may leave does: a rule
// that cannot cycle.
constexpr int kPatience = 20;

constexpr int kNone = -1;

double Largest(const std::vector<double>& x) {
  double largest = 0;
  for (const double entry : x) largest = std::max(largest, std::abs(entry));
  return largest;
}

}  // namespace

LevelSearch::LevelSearch(int num_variables,
                         const std::vector<LevelCapacity>& capacity)
    : n_(num_variables), y_(num_variables), step_(num_variables) {
  int most = 0;
  for (const LevelCapacity& level : capacity) {
    state_.emplace_back(level.inequalities, State::kFree);
    most = std::max(most, level.inequalities);
  }
  value_.resize(most);
  slope_.resize(most);
}

int LevelSearch::Search(const Hierarchy& hierarchy, Budget* budget,
                        ActiveProblem* problem,
                        std::vector<std::vector<Side>>* side) {
  const int levels = hierarchy.num_levels();
  std::fill(y_.begin(), y_.end(), 0);
  for (int level = 0; level <= levels; ++level) {
    // Of all that are optimal on this level, the one closest to y; of all that
    // are on every level, the smallest.
    const int used = std::min(level + 1, levels);
    problem->Plan(hierarchy, used, level < levels ? y_.data() : nullptr);
    if (level < levels) Begin(hierarchy, level, side);
    zero_steps_ = 0;
    int from_level = 0;
    while (from_level <= levels) {
      if (!budget->Take()) return level;
      problem->Solve(hierarchy, *side, from_level);
      problem->FindMultipliers();
      from_level = Advance(hierarchy, used, *problem, side);
      if (from_level == kNone) from_level = Drop(level, *problem, side);
      if (from_level == kNone) break;
    }
    if (level < levels) Keep(level, *problem, *side);
  }
  return levels + 1;
}

// The rows of a level that are violated are active to begin with.
void LevelSearch::Begin(const Hierarchy& hierarchy, int level,
                        std::vector<std::vector<Side>>* side) {
  const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
  const int rows = hierarchy.num_inequalities(level);
  kernels::Dots(hierarchy.C(level).data(), n_, rows, y_.data(), n_,
                value_.data());
  for (int i = 0; i < rows; ++i) {
    state_[level][i] = lower[i] == upper[i] ? State::kKept : State::kFree;
    (*side)[level][i] = value_[i] > upper[i] || lower[i] == upper[i]
                            ? Side::kUpper
                        : value_[i] < lower[i] ? Side::kLower
                                               : Side::kNone;
  }
}

// Goes towards the solution of the problem as far as rows that are not active
// allow. Returns the level of the row that is in the way, now active, or kNone
// if it has arrived.
int LevelSearch::Advance(const Hierarchy& hierarchy, int levels,
                         const ActiveProblem& problem,
                         std::vector<std::vector<Side>>* side) {
  for (int j = 0; j < n_; ++j) step_[j] = problem.y()[j] - y_[j];
  const double largest = Largest(step_);
  const double noise =
      kTolerance * largest + kRounding * (Largest(y_) + Largest(problem.y()));
  double length = 1, steepest = 0;
  int blocking_level = kNone, blocking = kNone;
  for (int level = 0; level < levels; ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    const double* C = hierarchy.C(level).data();
    kernels::Dots(C, n_, rows, step_.data(), n_, slope_.data());
    kernels::Dots(C, n_, rows, y_.data(), n_, value_.data());
    for (int i = 0; i < rows; ++i) {
      const double slope = slope_[i], norm = problem.norm(level, i);
      if ((*side)[level][i] != Side::kNone || std::abs(slope) <= noise * norm) {
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
        blocking_level = level;
        blocking = i;
      }
    }
  }
  zero_steps_ = length > 0 ? 0 : zero_steps_ + 1;
  if (blocking == kNone) {
    y_ = problem.y();
    return kNone;
  }
  const double* row = hierarchy.C(blocking_level).data() + blocking * n_;
  double slope;
  kernels::Dots(row, 0, 1, step_.data(), n_, &slope);
  (*side)[blocking_level][blocking] = slope > 0 ? Side::kUpper : Side::kLower;
  for (int j = 0; j < n_; ++j) y_[j] += length * step_[j];
  return blocking_level;
}

// Lets the row go that holds this level back most. Returns its level, or kNone.
int LevelSearch::Drop(int level, const ActiveProblem& problem,
                      std::vector<std::vector<Side>>* side) {
  int leaving = kNone;
  double worst = 0;
  for (int a = 0; a < problem.head().num_rows(); ++a) {
    const ActiveProblem::Row& row = problem.row(a);
    if (!row.is_inequality || state_[row.level][row.index] == State::kKept) {
      continue;
    }
    const Side at = (*side)[row.level][row.index];
    double price = 0;
    for (int l = row.level; l <= level && price == 0; ++l) {
      price = problem.Price(a, l, at, kTolerance);
    }
    if (price < worst) {
      leaving = a;
      if (zero_steps_ > kPatience) break;
      worst = price;
    }
  }
  if (leaving == kNone) return kNone;
  const ActiveProblem::Row& row = problem.row(leaving);
  (*side)[row.level][row.index] = Side::kNone;
  return row.level;
}

// What a level leaves violated stays so.
void LevelSearch::Keep(int level, const ActiveProblem& problem,
                       const std::vector<std::vector<Side>>& side) {
  for (int a = 0; a < problem.head().num_rows(); ++a) {
    const ActiveProblem::Row& row = problem.row(a);
    if (row.level == level && row.is_inequality &&
        problem.Price(a, level, side[level][row.index], kTolerance) > 0) {
      state_[level][row.index] = State::kKept;
    }
  }
}

}  // namespace poise
