// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>

namespace poise {

/// The budget of one solve: a number of factorisations, and seconds by a clock
/// if there is one.
class Budget {
 public:
  Budget(int max_iterations, double max_seconds,
         const std::function<double()>* now)
      : max_iterations_(max_iterations),
        max_seconds_(max_seconds),
        now_(max_seconds > 0 && *now ? now : nullptr),
        start_(now_ != nullptr ? (*now_)() : 0) {}

  /// Uses one factorisation. Returns false if the budget is spent, or if
  /// `limit` factorisations have been used.
  bool Take(int limit) {
    if (iterations_ >= max_iterations_ || iterations_ >= limit ||
        (now_ != nullptr && (*now_)() - start_ > max_seconds_)) {
      return false;
    }
    ++iterations_;
    return true;
  }
  bool Take() { return Take(max_iterations_); }

  int iterations() const { return iterations_; }
  int max_iterations() const { return max_iterations_; }

 private:
  int max_iterations_, iterations_ = 0;
  double max_seconds_;
  const std::function<double()>* now_;
  double start_;
};

}  // namespace poise
