// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "hqp/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hqp/kernels.h"

namespace poise {
namespace {

// A violation or multiplier below this, relative to what it is added up from,
// is zero. Where rounding alone keeps rows going in and out it is raised, up to
// what a certificate allows.
constexpr double kTolerance = 1e-11;
constexpr double kLargestTolerance = 3e-10;

// With the most violated row enter those violated at least this share of it.
constexpr double kShare = 0.3;

// The factorisations for all levels at once, if the budget is three times that;
// what takes more is solved level by level. And for the answer's last digits.
constexpr int kAtOnce = 20;
constexpr int kPolishing = 8;

// Orders of steps farther than any, and of none at all.
constexpr int kFar = -1;
constexpr int kNowhere = std::numeric_limits<int>::max();

}  // namespace

Solver::Solver(int num_variables, const std::vector<LevelCapacity>& capacity)
    : n_(num_variables),
      problem_(num_variables, capacity),
      by_level_(num_variables, capacity),
      reporter_(num_variables, capacity) {
  size_t rows = 0, most = 0;
  for (const LevelCapacity& level : capacity) {
    const size_t inequalities = level.inequalities;
    side_.emplace_back(inequalities, Side::kNone);
    is_fixed_.emplace_back(inequalities, false);
    RowState state;
    state.price.resize(capacity.size() + 1);
    state_.emplace_back(inequalities, state);
    rows += inequalities;
    most = std::max(most, inequalities);
  }
  best_side_ = side_;
  value_.resize(most);
  violated_.reserve(rows);
}

void Solver::Forget() noexcept {
  for (std::vector<Side>& side : side_) {
    std::fill(side.begin(), side.end(), Side::kNone);
  }
}

Status Solver::Solve(const Hierarchy& hierarchy, Solution* solution) noexcept {
  Budget budget(max_iterations, max_seconds, &now);
  solution->Reset();
  solution->status = problem_.Read(hierarchy, &solution->failed_level);
  if (solution->status != Status::kOptimal) return solution->status;
  Prepare(hierarchy);
  if (!Search(hierarchy, std::min(kAtOnce, max_iterations / 3), &budget)) {
    SearchByLevel(hierarchy, &budget, solution);
  }
  solution->iterations = budget.iterations();
  reporter_.Report(hierarchy, side_, kTolerance, &problem_, solution);
  return solution->status;
}

// The sides at work, as far as there are still such.
void Solver::Prepare(const Hierarchy& hierarchy) {
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
      Side& side = side_[level][i];
      is_fixed_[level][i] = lower[i] == upper[i];
      if (is_fixed_[level][i]) {
        side = Side::kUpper;
      } else if ((side == Side::kUpper && std::isinf(upper[i])) ||
                 (side == Side::kLower && std::isinf(lower[i]))) {
        side = Side::kNone;
      }
    }
  }
}

// All levels at once, from the last active set.
bool Solver::Search(const Hierarchy& hierarchy, int limit, Budget* budget) {
  const int num_levels = hierarchy.num_levels();
  problem_.Plan(hierarchy, num_levels);
  tolerance_ = kTolerance;
  bool is_priced = false;  // Whether no price is negative.
  int from_level = 0;
  while (budget->Take(limit)) {
    problem_.Solve(hierarchy, side_, from_level);
    problem_.FindMultipliers();
    from_level = is_priced ? Advance() : DropWrong();
    if (from_level < num_levels) continue;
    is_priced = true;
    FindViolated(hierarchy, false);
    if (violated_.empty()) {
      problem_.Refine(hierarchy);
      problem_.FindMultipliers();
      FindViolated(hierarchy, true);
      if (violated_.empty()) {
        problem_.RefineMultipliers(hierarchy);
        return true;
      }
    }
    from_level = EnterViolated();
  }
  return false;
}

// From none, level by level, so that what the budget leaves unsolved is at the
// bottom.
void Solver::SearchByLevel(const Hierarchy& hierarchy, Budget* budget,
                           Solution* solution) {
  const int levels = hierarchy.num_levels();
  Forget();
  Prepare(hierarchy);
  const int solved = by_level_.Search(hierarchy, budget, &problem_, &side_);
  if (solved <= levels) {
    solution->status = Status::kIterationLimit;
    solution->failed_level = std::max(std::min(solved, levels - 1), 0);
    problem_.Plan(hierarchy, solution->failed_level);
    problem_.Solve(hierarchy, side_, 0);
    problem_.RefineOther(hierarchy, by_level_.y());
    // Where rows nearly depend on others, that may lead astray.
    FindViolated(hierarchy, true);
    if (!violated_.empty()) problem_.TakeOther(hierarchy, by_level_.y());
    problem_.FindMultipliers();
    problem_.RefineMultipliers(hierarchy);
    return;
  }
  best_side_ = side_;
  if (Search(hierarchy, budget->iterations() + kPolishing, budget)) return;
  side_ = best_side_;
  problem_.Plan(hierarchy, levels);
  problem_.Solve(hierarchy, side_, 0);
  problem_.Refine(hierarchy);
  problem_.FindMultipliers();
  problem_.RefineMultipliers(hierarchy);
}

Solver::RowState& Solver::state(int a) {
  return state_[problem_.row(a).level][problem_.row(a).index];
}

const Solver::RowState& Solver::state(int a) const {
  return state_[problem_.row(a).level][problem_.row(a).index];
}

bool Solver::CanLeave(int a) const {
  const ActiveProblem::Row& row = problem_.row(a);
  return row.is_inequality && !is_fixed_[row.level][row.index];
}

double Solver::Price(int a, int level) const {
  const ActiveProblem::Row& row = problem_.row(a);
  return problem_.Price(a, level, side_[row.level][row.index], tolerance_);
}

bool Solver::IsWrong(int a) const {
  int level = problem_.row(a).level;
  while (level < problem_.num_levels() && Price(a, level) == 0) ++level;
  return Price(a, level) < 0;
}

int Solver::Drop(int a) {
  const ActiveProblem::Row& row = problem_.row(a);
  side_[row.level][row.index] = Side::kNone;
  return row.level;
}

// By a step of length.factor eps^length.order, where eps^l is what a price on
// level l counts.
void Solver::MovePrices(const Length& length) {
  const int levels = problem_.num_levels();
  for (int a = 0; a < problem_.head().num_rows(); ++a) {
    if (!CanLeave(a)) continue;
    const int own = problem_.row(a).level;
    std::vector<double>& price = state(a).price;
    // From the last level, as each reads the ones before it.
    for (int l = levels; l >= own + length.order; --l) {
      const int from = l - length.order;
      price[l] += length.factor * (Price(a, from) - price[from]);
    }
  }
}

// To begin with: whatever is left has no negative price.
int Solver::DropWrong() {
  int from_level = problem_.num_levels();
  for (int a = 0; a < problem_.head().num_rows(); ++a) {
    if (CanLeave(a) && IsWrong(a)) from_level = std::min(from_level, Drop(a));
  }
  if (from_level == problem_.num_levels()) {
    for (int a = 0; a < problem_.head().num_rows(); ++a) {
      if (CanLeave(a)) {
        std::fill(state(a).price.begin(), state(a).price.end(), 0);
      }
    }
    MovePrices({0, 1});
    ForgetNew();
  }
  return from_level;
}

// How far the prices can go until that of row a is zero. With eps^l for what a
// price on level l counts, the first price that is not zero leads; one that is
// smaller by k levels before the step than after it lasts for eps^k.
Solver::Length Solver::LengthTo(int a) const {
  if (!CanLeave(a) || state(a).is_new || !IsWrong(a)) return {kFar, 1};
  const std::vector<double>& price = state(a).price;
  int to = problem_.row(a).level, from = to;
  while (Price(a, to) == 0) ++to;
  while (from <= problem_.num_levels() && price[from] <= 0) ++from;
  if (from > problem_.num_levels()) return {kNowhere, 0};
  if (from < to) return {0, 1};
  const double ratio = price[from] / -Price(a, to);
  return {from - to, from == to ? ratio / (1 + ratio) : ratio};
}

// Moves the prices towards those of the last solve. Returns the first level
// that lost a row, or the number of levels if the prices have arrived.
int Solver::Advance() {
  const int rows = problem_.head().num_rows();
  int from_level = problem_.num_levels();

  // New rows that are not wanted beside the others leave. The champion is
  // wanted at least alone, so if it is not, the others leave.
  int champion = -1;
  for (int a = 0; a < rows; ++a) {
    const ActiveProblem::Row& row = problem_.row(a);
    if (CanLeave(a) && state(a).is_new && row.level == champion_.level &&
        row.index == champion_.index) {
      champion = a;
    }
  }
  const bool is_champion_wrong = champion >= 0 && IsWrong(champion);
  for (int a = 0; a < rows; ++a) {
    if (a == champion || !CanLeave(a) || !state(a).is_new) continue;
    if (is_champion_wrong || IsWrong(a)) {
      from_level = std::min(from_level, Drop(a));
    }
  }
  if (from_level < problem_.num_levels()) return from_level;
  if (is_champion_wrong) {
    // Only rounding does that.
    tolerance_ = std::min(10 * tolerance_, kLargestTolerance);
    return Drop(champion);
  }

  Length length = {kFar, 1};
  int leaving = -1;
  for (int a = 0; a < rows; ++a) {
    const Length to = LengthTo(a);
    if (to.order > length.order ||
        (to.order == length.order && to.factor < length.factor)) {
      length = to;
      leaving = a;
    }
  }
  if (leaving < 0) {
    MovePrices({0, 1});
    ForgetNew();
    return from_level;
  }
  if (length.order != kNowhere) {
    MovePrices(length);
    ForgetNew();
  }
  return Drop(leaving);
}

void Solver::ForgetNew() {
  for (std::vector<RowState>& level : state_) {
    for (RowState& state : level) state.is_new = false;
  }
}

void Solver::FindViolated(const Hierarchy& hierarchy, bool is_refined) {
  violated_.clear();
  const std::vector<double>& y = problem_.y();
  double largest = 0;
  for (double entry : y) largest = std::max(largest, std::abs(entry));
  for (int level = 0; level < problem_.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    kernels::Dots(hierarchy.C(level).data(), n_, rows, y.data(), n_,
                  value_.data());
    for (int i = 0; i < rows; ++i) {
      const double above = value_[i] - upper[i];
      const double below = lower[i] - value_[i];
      const double norm = problem_.norm(level, i);
      if ((above <= 0 && below <= 0) || norm == 0 ||
          side_[level][i] != Side::kNone) {
        continue;
      }
      const Side side = above > 0 ? Side::kUpper : Side::kLower;
      const double violation = std::max(above, below);
      const double bound = above > 0 ? upper[i] : lower[i];
      double size = norm * largest;
      if (is_refined) {
        double dot;
        kernels::DotWithSize(hierarchy.C(level).data() + i * n_, y.data(), n_,
                             &dot, &size);
      }
      if (violation > tolerance_ * (size + std::abs(bound))) {
        violated_.push_back({level, i, side, violation / norm});
      }
    }
  }
}

// Lets in the most violated row, and those violated at least a share of it.
// Returns the first level that changes.
int Solver::EnterViolated() {
  champion_ = violated_.front();
  for (const Violation& row : violated_) {
    if (row.size > champion_.size) champion_ = row;
  }
  int from_level = problem_.num_levels();
  for (const Violation& row : violated_) {
    if (row.size < kShare * champion_.size) continue;
    side_[row.level][row.index] = row.side;
    RowState& state = state_[row.level][row.index];
    state.is_new = true;
    std::fill(state.price.begin(), state.price.end(), 0);
    from_level = std::min(from_level, row.level);
  }
  return from_level;
}

}  // namespace poise
