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
};

/// Modelled time [s] of a solve. It depends on the problem alone, so that a
/// replay with such a limit is exact. The times are a fit to 19200 solves of 24
/// sequences on a quiet machine. Of the solves that took more than 250 us, 98 % took
/// between 0.76 and 1.18 of the modelled time
/// (docs/notebook/2026-11-27-fixed-variables.md). Gaps of the certificate came later:
/// where many rows are active, solves take 1.2 to 1.9 of the modelled time now
/// (docs/notebook/2026-11-29-alternations.md). The time of a solve covers the
/// check of the input, refinement, multipliers and the certificate.
inline double ModelledSeconds(const Work& work, int iterations) {
  constexpr double kPerSolve = 16e-6, kPerEntry = 5.1e-9;
  constexpr double kPerIteration = 3.1e-6, kPerIterationAndEntry = 0.76e-9;
  constexpr double kPerMultiplyAdd = 0.129e-9;
  return kPerSolve + kPerEntry * work.num_entries +
         (kPerIteration + kPerIterationAndEntry * work.num_entries) *
             iterations +
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
