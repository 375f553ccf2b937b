// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// WorkingSetProblem: multipliers and other combinations of rows.
#include <algorithm>
#include <cmath>

#include "poise/hqp/fast/kernels.h"
#include "poise/hqp/fast/tolerances.h"
#include "poise/hqp/fast/working_set_problem.h"

namespace poise {

void WorkingSetProblem::FindMultipliers(int end) {
  for (int level = 0; level < end; ++level) {
    Multipliers& out = multipliers_[level];
    const int rows =
        level < num_leading_ ? leading_.first_row(level) : leading_.num_rows();
    if (level < num_leading_) {
      out.size = leading_.Gradient(level, gradient_.data());
      out.any = out.size > 0;
      if (!out.any) continue;
      for (double& entry : gradient_) entry = -entry;
      leading_.SolveDual(level, gradient_.data(), out.nu.data());
    } else {
      out.size = diagonal_.Dual(leading_, level - num_leading_,
                                gradient_.data(), out.left.data());
      out.any = out.size > 0;
      if (!out.any) continue;
      leading_.SolveDual(num_leading_, gradient_.data(), out.nu.data());
    }
    for (int a = 0; a < rows; ++a) {
      out.size = std::max(out.size, std::abs(out.nu[a]));
    }
  }
}

void WorkingSetProblem::FindMultipliersOfApproach(
    const std::vector<double>& y) {
  FindMultipliers(num_leading_);
  Multipliers& out = multipliers_[num_leading_];
  for (int j = 0; j < n_; ++j) change_[j] = y[j] - y_[j];
  leading_.Project(change_.data(), leading_.rank(), gradient_.data());
  leading_.SolveDual(num_leading_, gradient_.data(), out.nu.data());
  // A step that is rounding has no multipliers.
  const double largest = kernels::Largest(change_.data(), n_);
  out.any = largest > tolerances::kSolutionRounding *
                          (kernels::Largest(y.data(), n_) + Size());
  out.size = 0;
  for (int a = 0; a < leading_.num_rows(); ++a) {
    out.size = std::max(out.size, std::abs(out.nu[a]));
  }
}

void WorkingSetProblem::RefineMultipliers(const Hierarchy& hierarchy) {
  for (int level = 0; level < num_levels_; ++level) {
    Multipliers& of = multipliers_[level];
    // A leading level also stores the weighted residuals of its own rows, even
    // if its multipliers on other rows are zero.
    const bool is_leading = level < num_leading_;
    if (!of.any) {
      if (!is_leading || !leading_.is_deficient(level)) continue;
      std::fill_n(of.nu.begin(), leading_.first_row(level), 0);
    }
    // Refinement has met the level after its multipliers were computed.
    if (!is_leading && diagonal_.IsMet(level - num_leading_, y_.data())) {
      of.any = false;
      continue;
    }
    const int levels = is_leading ? level + 1 : num_leading_;
    const int rows = is_leading ? leading_.end_row(level) : leading_.num_rows();
    const int rank = is_leading ? leading_.rank(level) : leading_.rank();
    std::vector<double>& left = change_;
    std::fill(left.begin(), left.end(), 0);
    if (is_leading) {
      for (int a = leading_.first_row(level); a < rows; ++a) {
        of.nu[a] = leading_.weight(a) * leading_.residual(a);
      }
    } else {
      diagonal_.AddGradient(level - num_leading_, y_.data(), of.left.data(),
                            left.data());
    }
    for (int a = 0; a < rows; ++a) {
      AddToSum(hierarchy, a, of.nu[a], left.data());
    }
    if (!is_leading) {
      diagonal_.ZeroRounding(level - num_leading_, y_.data(), left.data());
    }
    leading_.Project(left.data(), rank, gradient_.data());
    for (int e = 0; e < rank; ++e) gradient_[e] = -gradient_[e];
    leading_.SolveDual(levels, gradient_.data(), nu_.data());
    for (int a = 0; a < rows; ++a) of.nu[a] += nu_[a];
  }
}

int WorkingSetProblem::FindTradeOff(int level, double* trade_off) {
  const Multipliers& of = multipliers_[level];
  if (!of.any) return -1;
  for (int above = std::min(level, num_leading_) - 1; above >= 0; --above) {
    if (!leading_.is_deficient(above)) continue;
    // Along p, row a changes by nu_a / d_a^2, and the rows above do not change.
    bool any = false;
    std::fill_n(nu_.begin(), leading_.num_rows(), 0);
    for (int a = leading_.first_row(above); a < leading_.end_row(above); ++a) {
      nu_[a] = of.nu[a] / leading_.weight(a);
      any |= nu_[a] != 0;
    }
    if (!any) continue;
    leading_.Correct(nu_.data(), above + 1, change_.data());
    std::fill_n(trade_off, n_, 0);
    leading_.AddCombination(change_.data(), leading_.rank(above), trade_off);
    return above;
  }
  return -1;
}

WorkingSetProblem::Combination WorkingSetProblem::FindCombination(
    const double* row) {
  const int rank = leading_.rank();
  leading_.Project(row, rank, gradient_.data());
  const double squared_length = kernels::SquaredNorm(row, n_);
  const double squared_remainder =
      squared_length - kernels::SquaredNorm(gradient_.data(), rank);
  constexpr double kLarge =
      tolerances::kReorthogonalize * tolerances::kReorthogonalize;
  if (squared_remainder > kLarge * squared_length) {
    return {nullptr, std::sqrt(squared_remainder)};
  }
  // A difference of squares would not resolve a remainder below 1e-8.
  for (int e = 0; e < rank; ++e) nu_[e] = -gradient_[e];
  std::copy_n(row, n_, change_.begin());
  leading_.AddCombination(nu_.data(), rank, change_.data());
  const double remainder = std::sqrt(kernels::SquaredNorm(change_.data(), n_));
  if (remainder > tolerances::kIndependentPart * std::sqrt(squared_length))
    return {nullptr, remainder};
  leading_.SolveDual(leading_.num_levels(), gradient_.data(), nu_.data());
  return {nu_.data(), remainder};
}

}  // namespace poise
