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

/// Modelled time [s] of a solve. It depends on the problem alone, so that a
/// replay with such a limit is exact. The three times are a fit to 1193 solves
/// on a slow machine: 98 % of the predictions were between 0.78 and 1.12 of the
/// measured time. All three are then multiplied by 0.73, the speed of a quiet
/// machine. Since the fit, products with zeros are skipped, and a multiply-add that
/// remains takes 1.08 times as long (docs/notebook/2026-11-27-limits-first.md). The
/// time of a solve covers the check of the input, refinement, multipliers and the
/// certificate.
inline double ModelledSeconds(std::int64_t multiply_adds, int iterations) {
  constexpr double kPerMultiplyAdd = 0.178e-9;
  constexpr double kPerIteration = 4.6e-6, kPerSolve = 25e-6;
  return kPerSolve + kPerIteration * iterations +
         kPerMultiplyAdd * static_cast<double>(multiply_adds);
}

/// The budget of one solve.
class Budget {
 public:
  Budget(const BudgetLimits& limits, const std::function<double()>* now)
      : limits_(limits),
        now_(limits.seconds > 0 && *now ? now : nullptr),
        start_(now_ != nullptr ? (*now_)() : 0) {}

  /// Uses one factorisation, after `multiply_adds` in this solve. Returns false
  /// if the budget is spent, or if `limit` factorisations have been used. Limits
  /// of time allow two factorisations: the first finds the start, and the second
  /// the direction of a step.
  bool Take(int limit, std::int64_t multiply_adds) {
    if (iterations_ >= limit) return false;
    is_spent_ = is_spent_ || iterations_ >= limits_.iterations ||
                (iterations_ > 1 && IsLate(multiply_adds));
    if (is_spent_) return false;
    ++iterations_;
    return true;
  }
  bool Take(std::int64_t multiply_adds) {
    return Take(limits_.iterations + 1, multiply_adds);
  }

  /// Returns whether Take() has failed for another reason than `limit`.
  bool is_spent() const { return is_spent_; }
  /// Returns whether the time is limited, modelled or measured.
  bool has_time_limit() const {
    return limits_.modelled_seconds > 0 || now_ != nullptr;
  }
  int iterations() const { return iterations_; }
  int max_iterations() const { return limits_.iterations; }

 private:
  bool IsLate(std::int64_t multiply_adds) const {
    return (limits_.modelled_seconds > 0 &&
            ModelledSeconds(multiply_adds, iterations_) >
                limits_.modelled_seconds) ||
           (now_ != nullptr && (*now_)() - start_ > limits_.seconds);
  }

  BudgetLimits limits_;
  int iterations_ = 0;
  bool is_spent_ = false;
  const std::function<double()>* now_;
  double start_;
};

}  // namespace poise
