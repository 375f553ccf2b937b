// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>

namespace poise {

/// Limits of one solve.
struct BudgetLimits {
  int iterations;               ///< Number of factorisations and updates.
  double modelled_seconds = 0;  ///< By ModelledSeconds(); 0: no limit.
  double seconds = 0;           ///< By now(); 0: no limit.
};

/// Work of a solve.
struct Work {
  /// Multiply-adds of factorisations, updates, substitutions and products with
  /// Q, and kernels::kRowOverhead more for each row. Substitutions of the
  /// diagonal levels with triangles are not counted.
  std::int64_t multiply_adds = 0;
  /// Entries of all rows of the hierarchy, within their spans.
  int num_entries = 0;
  /// Inequalities of the working set that was solved last, of the levels in
  /// use.
  int num_active = 0;
  /// Sum of num_active over all working sets.
  std::int64_t sum_active = 0;
  /// Working sets that were solved with all leading levels, and with some of
  /// them. A working set counts also if its factorisation was interrupted.
  int num_solved = 0, num_partly_solved = 0;
};

/// Modelled time [s] of a multiply-add.
inline constexpr double kSecondsPerMultiplyAdd = 0.145e-9;

/// Modelled time [s] of a solve. It depends on the problem alone, so that a
/// replay with such a limit is exact. The time covers the check of the input,
/// refinement, multipliers and the certificate. The constants are 1.08 times a
/// fit to 55600 solves of 24 sequences, each the fastest of 32 runs with its
/// rows in the cache. Solves that are modelled with 250 to 350 us take 0.94 of
/// this time in the median, 90 % between 0.7 and 1.1, and 99 % less than 1.2.
/// With a budget of 300 us, the longest solve took 397 to 402 us on the machine
/// of the fit. So the factor must not be smaller. On a faster machine, the
/// longest one took 315 us (docs/notebook/2026-11-30-rows-without-calls.md).
inline double ModelledSeconds(const Work& work) {
  constexpr double kPerSolve = 1.5e-6, kPerEntry = 5.2e-9, kPerActive = 0.53e-6;
  constexpr double kPerWorkingSet = 5.2e-6, kPerPartOfOne = 1.7e-6;
  constexpr double kPerWorkingSetAndActive = 0.092e-6;
  return kPerSolve + kPerEntry * work.num_entries +
         kPerActive * work.num_active + kPerWorkingSet * work.num_solved +
         kPerPartOfOne * work.num_partly_solved +
         kPerWorkingSetAndActive * static_cast<double>(work.sum_active) +
         kSecondsPerMultiplyAdd * static_cast<double>(work.multiply_adds);
}

/// The budget of one solve.
class Budget {
 public:
  /// An iteration is interrupted when the solve has taken this multiple of the
  /// limit, but for the first kAlways ones. The value hardly matters: with
  /// 1.02, 1.04, 1.06 and 1.1, recorded robots that stay up lose momentum in 22
  /// or 23 ticks (docs/notebook/2026-11-30-rows-without-calls.md).
  static constexpr double kMost = 1.06;
  /// Limits of time allow so many iterations, even if the time is over, and do
  /// not interrupt them: the first finds the start, and the second the
  /// direction of a step.
  static constexpr int kAlways = 2;
  /// More multiply-adds than any solve takes.
  static constexpr std::int64_t kUnlimited = 1000000000000000;

  Budget(const BudgetLimits& limits, const std::function<double()>* now)
      : limits_(limits),
        now_(limits.seconds > 0 && *now ? now : nullptr),
        start_(now_ != nullptr ? (*now_)() : 0) {}

  /// Uses one iteration, which factors or updates the levels, after this work
  /// in this solve. Returns false if the budget is spent, if `limit` iterations
  /// have been used, or if the time exceeds the share that was set.
  bool Take(int limit, const Work& work) {
    if (iterations_ >= limit) return false;
    const double used = iterations_ >= kAlways ? UsedTime(work) : 0;
    is_spent_ = is_spent_ || iterations_ >= limits_.iterations || used > 1;
    is_share_spent_ = !is_spent_ && used > share_;
    if (is_spent_ || is_share_spent_) return false;
    ++iterations_;
    return true;
  }
  bool Take(const Work& work) {
    return Take(std::numeric_limits<int>::max(), work);
  }

  /// Sets the share of the limits of time, up to 1, after which Take() returns
  /// false without ending the budget.
  void set_share(double share) { share_ = share; }
  /// Returns whether the share, but not the whole time, was spent at the last
  /// Take() that did not fail because of `limit`.
  bool is_share_spent() const { return is_share_spent_; }

  /// Returns how many multiply-adds the iteration of the last Take() may use,
  /// after this work, so that it does not end later than kMost times the limit
  /// of time. For the first kAlways iterations, this is kUnlimited: each solve
  /// advances the search.
  std::int64_t MultiplyAddsLeft(const Work& work) const {
    if (iterations_ <= kAlways) return kUnlimited;
    double left = std::numeric_limits<double>::infinity();
    if (limits_.modelled_seconds > 0) {
      left = kMost * limits_.modelled_seconds - ModelledSeconds(work);
    }
    if (now_ != nullptr) {
      left = std::min(left, kMost * limits_.seconds - Elapsed());
    }
    // The limit may be infinite, and a clock may jump.
    constexpr double kLargest = kUnlimited;
    return static_cast<std::int64_t>(
        std::clamp(left / kSecondsPerMultiplyAdd, -kLargest, kLargest));
  }

  /// Ends the budget, also before its time.
  void Spend() { is_spent_ = true; }

  /// Returns whether the budget has ended, by Spend() or because Take() has
  /// failed for another reason than `limit` or the share.
  bool is_spent() const { return is_spent_; }
  /// Returns whether the time is limited, modelled or measured.
  bool has_time_limit() const {
    return limits_.modelled_seconds > 0 || now_ != nullptr;
  }
  int iterations() const { return iterations_; }
  int max_iterations() const { return limits_.iterations; }

 private:
  // Returns the time that has passed, as a part of the limits: the larger one.
  double UsedTime(const Work& work) const {
    double used = 0;
    if (limits_.modelled_seconds > 0) {
      used = ModelledSeconds(work) / limits_.modelled_seconds;
    }
    if (now_ != nullptr) used = std::max(used, Elapsed() / limits_.seconds);
    return used;
  }
  double Elapsed() const { return (*now_)() - start_; }

  BudgetLimits limits_;
  double share_ = 1;
  int iterations_ = 0;
  bool is_spent_ = false, is_share_spent_ = false;
  const std::function<double()>* now_;
  double start_;
};

}  // namespace poise
