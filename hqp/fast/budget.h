// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <functional>

namespace poise {

/// Limits of one solve.
struct BudgetLimits {
  int iterations;               ///< Number of factorisations and updates.
  double modelled_seconds = 0;  ///< By ModelledSeconds(); 0: no limit.
  double seconds = 0;           ///< By now(); 0: no limit.
};

/// Work of a solve.
struct Work {
  /// Multiply-adds of factorisations, updates, substitutions and products with Q, and
  /// kernels::kRowOverhead more for each row. Substitutions of the diagonal levels
  /// with triangles are not counted.
  std::int64_t multiply_adds = 0;
  /// Entries of all rows of the hierarchy, within their spans.
  int num_entries = 0;
  /// Inequalities of the working set that was factored last, of the levels in use.
  int num_active = 0;
  /// Sum of num_active over all working sets that were factored.
  std::int64_t sum_active = 0;
};

/// Modelled time [s] of a solve. It depends on the problem alone, so that a
/// replay with such a limit is exact. The time covers the check of the input, refinement,
/// multipliers and the certificate. The constants are a fit to 55600 solves of 24
/// sequences, each the fastest of 15 runs with its rows in the cache. Of the solves that
/// are modelled with 250 to 350 us, 90 % took between 0.69 and 1.23 of this time, and 99 %
/// less than 1.32 (docs/notebook/2026-11-29-updates.md).
inline double ModelledSeconds(const Work& work, int iterations) {
  constexpr double kPerSolve = 9.3e-6, kPerEntry = 4.4e-9;
  constexpr double kPerIteration = 0.8e-6, kPerIterationAndEntry = 0.5e-9;
  constexpr double kPerMultiplyAdd = 0.177e-9;
  constexpr double kPerActive = 0.79e-6, kPerIterationAndActive = 0.115e-6;
  return kPerSolve + kPerEntry * work.num_entries +
         kPerActive * work.num_active +
         (kPerIteration + kPerIterationAndEntry * work.num_entries) *
             iterations +
         kPerIterationAndActive * static_cast<double>(work.sum_active) +
         kPerMultiplyAdd * static_cast<double>(work.multiply_adds);
}

/// The budget of one solve.
class Budget {
 public:
  Budget(const BudgetLimits& limits, const std::function<double()>* now)
      : limits_(limits),
        now_(limits.seconds > 0 && *now ? now : nullptr),
        start_(now_ != nullptr ? (*now_)() : 0) {}

  /// Uses one iteration, which factors or updates the levels, after this work in this
  /// solve. Returns false if the budget is spent, or if `limit` iterations have been
  /// used. Limits of time allow two iterations: the first finds the start, and the
  /// second the direction of a step.
  bool Take(int limit, const Work& work) {
    if (iterations_ >= limit) return false;
    is_spent_ = is_spent_ || iterations_ >= limits_.iterations ||
                (iterations_ > 1 && IsLate(work));
    if (is_spent_) return false;
    ++iterations_;
    return true;
  }
  bool Take(const Work& work) { return Take(limits_.iterations + 1, work); }

  /// Returns whether Take() has failed for another reason than `limit`.
  bool is_spent() const { return is_spent_; }
  /// Returns whether the time is limited, modelled or measured.
  bool has_time_limit() const {
    return limits_.modelled_seconds > 0 || now_ != nullptr;
  }
  int iterations() const { return iterations_; }
  int max_iterations() const { return limits_.iterations; }

 private:
  bool IsLate(const Work& work) const {
    return (limits_.modelled_seconds > 0 &&
            ModelledSeconds(work, iterations_) > limits_.modelled_seconds) ||
           (now_ != nullptr && (*now_)() - start_ > limits_.seconds);
  }

  BudgetLimits limits_;
  int iterations_ = 0;
  bool is_spent_ = false;
  const std::function<double()>* now_;
  double start_;
};

}  // namespace poise
