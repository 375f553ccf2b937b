// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/solver.h"

#include <algorithm>
#include <cmath>

#include "poise/hqp/certificate.h"
#include "poise/hqp/fast/active_set_search.h"
#include "poise/hqp/fast/budget.h"
#include "poise/hqp/fast/cost_order.h"
#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/multipliers.h"
#include "poise/hqp/fast/parametric_search.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/hqp/fast/working_set_problem.h"

namespace poise {
namespace {

// Refinement can find rows violated in their last digits. These rows are added
// to the working set at most this often.
constexpr int kMaxRefinementPasses = 5;

// A search on all levels at once that takes half of the budget is likely to
// cycle by rounding, and the rest is for a search level by level. But with
// fewer iterations than this, the second search would not end either. Of 27800
// recorded ticks, only some with 5 % of the torque take more.
constexpr int kMinIterationsAtOnce = 250;

// After this number of solves in a row that the budget ended, a search starts
// from an empty working set: the optimum may be easy to find from there, but
// far from the last y. Paths of robots that stay up take up to 13 solves of 300
// us; with 8, such starts interrupt them (docs/notebook/2026-11-27-paths.md).
constexpr int kMaxCutOff = 24;

}  // namespace

class Solver::Impl {
 public:
  Impl(int num_variables, const std::vector<LevelCapacity>& capacity,
       int max_leading_rows, int max_kept_rows);
  Status Solve(const Hierarchy& hierarchy, bool finds_nullity, Budget* budget,
               Solution* solution);
  void Forget();
  /// Work of the last solve.
  Work work() const { return problem_.work(); }

 private:
  void Refuse(const Hierarchy& hierarchy, Status status, int failed_level,
              Solution* solution);
  void StartOver(const Hierarchy& hierarchy);
  void RememberSearch();
  void RecallSearch();
  bool SearchAtOnce(const Hierarchy& hierarchy, int limit, Budget* budget);
  void SearchByLevel(const Hierarchy& hierarchy, Budget* budget,
                     Solution* solution);
  void KeepSearch(const Hierarchy& hierarchy, Solution* solution);
  void FindMultipliers(const Hierarchy& hierarchy);
  bool AddViolated(const Hierarchy& hierarchy, bool adds);
  bool WriteSolution(const Hierarchy& hierarchy, Solution* solution);

  int n_;
  /// Solves in a row that the budget ended, since the last start over.
  int num_cut_off_ = 0;
  WorkingSetProblem problem_;
  ActiveSetSearch search_;
  MultiplierWriter writer_;
  Certifier certifier_;
  std::vector<std::vector<Side>> side_, best_side_, solved_side_;
  std::vector<double> value_, best_y_;
};

Solver::Impl::Impl(int num_variables,
                   const std::vector<LevelCapacity>& capacity,
                   int max_leading_rows, int max_kept_rows)
    : n_(num_variables),
      problem_(num_variables, capacity, max_leading_rows, max_kept_rows),
      search_(num_variables, capacity),
      writer_(num_variables),
      certifier_(num_variables, capacity, max_leading_rows) {
  int most = 0;
  for (const LevelCapacity& level : capacity) {
    side_.emplace_back(level.inequalities, Side::kNone);
    most = std::max(most, level.inequalities);
  }
  best_side_ = solved_side_ = side_;
  value_.resize(most);
  best_y_.resize(n_);
}

void Solver::Impl::Forget() {
  for (std::vector<Side>& side : side_) {
    std::fill(side.begin(), side.end(), Side::kNone);
  }
  search_.Forget();
  problem_.Forget();
  num_cut_off_ = 0;
}

Status Solver::Impl::Solve(const Hierarchy& hierarchy, bool finds_nullity,
                           Budget* budget, Solution* solution) {
  writer_.finds_nullity = finds_nullity;
  int failed_level;
  const Status status = problem_.Read(hierarchy, &failed_level);
  if (status != Status::kOptimal) {
    Refuse(hierarchy, status, failed_level, solution);
    num_cut_off_ = 0;
    return status;
  }
  solution->Reset(hierarchy);
  search_.Resume(&side_);
  FitToBounds(hierarchy, &side_);
  const int at_once =
      std::max(kMinIterationsAtOnce, budget->max_iterations() / 2);
  const int num_cut_off = num_cut_off_;
  const bool starts_over = num_cut_off == kMaxCutOff;
  if (starts_over) StartOver(hierarchy);
  const bool is_complete = SearchAtOnce(hierarchy, at_once, budget);
  if (budget->is_spent()) {
    const bool goes_back =
        starts_over && IsBetter(hierarchy, best_y_, search_.y());
    // To factor the rows of this y again would take longer than the limit
    // allows.
    if (goes_back) RecallSearch();
    if (budget->iterations() == 0) {
      problem_.Plan(hierarchy, hierarchy.num_levels());
      problem_.SolveLeading(hierarchy, side_);
    }
    KeepSearch(hierarchy, solution);
  } else if (!is_complete || !WriteSolution(hierarchy, solution)) {
    RememberSearch();
    solution->Reset(hierarchy);
    SearchByLevel(hierarchy, budget, solution);
    if (budget->is_spent() && IsBetter(hierarchy, best_y_, search_.y())) {
      RecallSearch();
      solution->Reset(hierarchy);
      problem_.Plan(hierarchy, hierarchy.num_levels());
      problem_.SolveLeading(hierarchy, side_);
      KeepSearch(hierarchy, solution);
    } else if (!WriteSolution(hierarchy, solution) ||
               solution->failed_level >= 0) {
      certifier_.Truncate(hierarchy, solution);
    }
  }
  num_cut_off_ = budget->is_spent() && !starts_over ? num_cut_off + 1 : 0;
  if (!solution->y.allFinite()) {
    // The next search must not go on from numbers that have overflowed.
    Forget();
    Refuse(hierarchy, Status::kNotFinite, 0, solution);
  }
  solution->iterations = budget->iterations();
  return solution->status;
}

// Writes y = 0. The gaps of an invalid hierarchy are infinite.
void Solver::Impl::Refuse(const Hierarchy& hierarchy, Status status,
                          int failed_level, Solution* solution) {
  solution->Reset();
  solution->status = status;
  solution->failed_level = failed_level;
  solution->certificate = certifier_.Certify(hierarchy, *solution);
}

// Remembers the last search and forgets it. The rows have changed since, so
// that its y is first moved to the levels that every search meets.
void Solver::Impl::StartOver(const Hierarchy& hierarchy) {
  RememberSearch();
  problem_.Plan(hierarchy, hierarchy.num_levels());
  problem_.UseLeading(problem_.NumFirstLevels(hierarchy));
  problem_.SolveLeading(hierarchy, side_);
  problem_.MoveToFirstLevels(hierarchy, &best_y_);
  Forget();
  FitToBounds(hierarchy, &side_);
}

void Solver::Impl::RememberSearch() {
  best_side_ = side_;
  best_y_ = search_.y();
}

void Solver::Impl::RecallSearch() {
  side_ = best_side_;
  search_.set_y(best_y_);
}

// Searches on all levels at once, from the last working set and y. Returns
// false if the budget, or `limit` iterations of it, did not suffice.
bool Solver::Impl::SearchAtOnce(const Hierarchy& hierarchy, int limit,
                                Budget* budget) {
  for (int pass = 0;; ++pass) {
    // Refinement has found rows violated in their last digits. A path from the
    // last optimum would follow this rounding.
    if (pass > 0) search_.ForgetPath();
    if (!search_.AllAtOnce(hierarchy, limit, budget, &problem_, &side_)) {
      return false;
    }
    problem_.Refine(hierarchy);
    if (pass == kMaxRefinementPasses || !AddViolated(hierarchy, true)) break;
  }
  // The search has found the multipliers. Refined, they are certified also
  // where targets are large (large_targets_test.cc).
  problem_.RefineMultipliers(hierarchy);
  return true;
}

// Searches level by level from an empty working set. If the budget is spent,
// only the lowest levels are not solved.
void Solver::Impl::SearchByLevel(const Hierarchy& hierarchy, Budget* budget,
                                 Solution* solution) {
  const int levels = hierarchy.num_levels();
  Forget();
  FitToBounds(hierarchy, &side_);
  const int solved = search_.LevelByLevel(hierarchy, budget, &problem_, &side_);
  if (solved > levels) {
    solved_side_ = side_;
    if (SearchAtOnce(hierarchy, budget->iterations() + kMaxRefinementPasses,
                     budget)) {
      return;
    }
    side_ = solved_side_;
    problem_.Plan(hierarchy, levels);
    problem_.Solve(hierarchy, side_);
    problem_.Refine(hierarchy);
    search_.set_y(problem_.y());
  } else {
    solution->status = Status::kIterationLimit;
    solution->failed_level = std::max(std::min(solved, levels - 1), 0);
    problem_.Plan(hierarchy, solution->failed_level);
    problem_.Solve(hierarchy, side_);
    problem_.RefineFrom(hierarchy, search_.y());
    // Nearly dependent rows can make refinement move y across a bound.
    if (AddViolated(hierarchy, false)) {
      problem_.SetSolution(hierarchy, search_.y());
    }
  }
  FindMultipliers(hierarchy);
}

// Writes the y at which the budget of the search on all levels was spent. The
// multipliers are those of the rows that were factored last, which may differ
// from the working set by the last change, or altogether if the search has
// started over in vain. Levels that were not solved have none.
void Solver::Impl::KeepSearch(const Hierarchy& hierarchy, Solution* solution) {
  problem_.LeaveOutUnsolved();
  problem_.SetSolution(hierarchy, search_.y());
  FindMultipliers(hierarchy);
  writer_.Write(hierarchy, side_, &problem_, solution);
  certifier_.Truncate(hierarchy, solution);
  if (solution->status == Status::kOptimal) {
    // No search has shown that y is the shortest one.
    solution->status = Status::kIterationLimit;
    const int last = std::max(hierarchy.num_levels() - 1, 0);
    solution->failed_level = last;
    // All levels are certified, so that the gap of the last one holds as well.
    const double gap = hierarchy.num_levels() > 0 ? certifier_.gap(last) : 0;
    certifier_.Certify(hierarchy, solution);
    if (hierarchy.num_levels() > 0) solution->levels[last].gap = gap;
  }
  search_.Stop(hierarchy, problem_, &side_);
}

void Solver::Impl::FindMultipliers(const Hierarchy& hierarchy) {
  problem_.FindAllMultipliers();
  problem_.RefineMultipliers(hierarchy);
}

// Returns whether y violates a row outside the working set, relative to the
// magnitudes of its terms. If `adds`, such rows are added to the working set.
bool Solver::Impl::AddViolated(const Hierarchy& hierarchy, bool adds) {
  bool any = false;
  const std::vector<double>& y = problem_.y();
  for (int level = 0; level < problem_.num_levels(); ++level) {
    const auto lower = hierarchy.lower(level), upper = hierarchy.upper(level);
    const int rows = hierarchy.num_inequalities(level);
    kernels::SpanDots(hierarchy.C(level).data(), n_, hierarchy.C_span(level),
                      rows, y.data(), value_.data());
    for (int i = 0; i < rows; ++i) {
      const double above = value_[i] - upper[i];
      const double below = lower[i] - value_[i];
      Side& side = side_[level][i];
      if ((above <= 0 && below <= 0) || side != Side::kNone ||
          problem_.norm(level, i) == 0) {
        continue;
      }
      const double* row = hierarchy.C(level).data() + i * n_;
      const double bound = above > 0 ? upper[i] : lower[i];
      const auto is_violated = [&] {
        double dot, size;
        kernels::DotWithSize(row, y.data(), n_, &dot, &size);
        const double beyond = above > 0 ? dot - bound : bound - dot;
        return beyond > tolerances::kZeroSlope * (size + std::abs(bound));
      };
      if (!is_violated() ||
          (problem_.ZeroRoundingEntries(hierarchy, row) && !is_violated())) {
        continue;
      }
      any = true;
      if (adds) side = above > 0 ? Side::kUpper : Side::kLower;
    }
  }
  return any;
}

// Writes the answer with its certificate. Returns whether all levels above
// failed_level are certified.
bool Solver::Impl::WriteSolution(const Hierarchy& hierarchy,
                                 Solution* solution) {
  writer_.Write(hierarchy, side_, &problem_, solution);
  certifier_.Certify(hierarchy, solution);
  return solution->certificate.worst() <= Certifier::kCertified;
}

Solver::Solver(int num_variables, const std::vector<LevelCapacity>& capacity)
    : impl_(std::make_unique<Impl>(num_variables, capacity, NumRows(capacity),
                                   2 * num_variables)) {}
Solver::Solver(int num_variables, const std::vector<LevelCapacity>& capacity,
               int max_leading_rows)
    : impl_(std::make_unique<Impl>(num_variables, capacity, max_leading_rows,
                                   (num_variables + 1) / 2)) {}
Solver::Solver(Solver&& other) noexcept = default;
Solver& Solver::operator=(Solver&& other) noexcept = default;
Solver::~Solver() = default;

void Solver::Forget() noexcept { impl_->Forget(); }

Status Solver::Solve(const Hierarchy& hierarchy, Solution* solution) noexcept {
  Budget budget({max_iterations, max_modelled_seconds, max_seconds}, &now);
  const Status status =
      impl_->Solve(hierarchy, finds_nullity, &budget, solution);
  modelled_seconds_ = ModelledSeconds(impl_->work());
  return status;
}

}  // namespace poise
