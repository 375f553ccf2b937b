// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Computes the certificate of an answer from (levels, y, multipliers) alone.
/// It shares no code with the solvers.
class Certifier {
 public:
  Certifier(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Certifies all levels, or those above solution.failed_level if there is
  /// one. Does not read solution.certificate. Cost: about 4 n flops per row,
  /// and 4 n per nonzero multiplier. Does not allocate.
  Certificate Certify(const Hierarchy& hierarchy,
                      const Solution& solution) noexcept;

  /// After Certify() or Truncate(): how far the cost of a level may be above its
  /// optimum, given the levels above. This is the whole cost for the first level
  /// that is not certified, and infinite below it.
  ///
  /// With d = y' - y for any y' that is optimal on the levels above and no
  /// farther from y than R = 2 (|y| + largest distance of a row from y = 0),
  /// convexity gives
  ///     cost_k(y) - cost_k(y') <= |g_k| R + sum_{j<k} (lambda_kj' B_j d
  ///                                                    + mu_kj' C_j d).
  /// An inactive bound allows C_i d up to its distance. A row with a residual or
  /// a slack changes by 2 sqrt(gap_j) at most, because cost_j is quadratic in
  /// it. The gap contains the rounding of g_k and of the cost, n eps times the
  /// magnitudes of their terms. But for this rounding, it never exceeds the
  /// cost.
  double gap(int level) const { return gap_[static_cast<size_t>(level)]; }

  /// Upper limit of Certificate::worst() for an answer with status kOptimal.
  static constexpr double kCertified = 1e-9;

  /// Certifies the answer and stores solution->certificate. While its worst()
  /// exceeds kCertified, sets the status to kIterationLimit and moves
  /// failed_level one level up, towards level 0.
  void Truncate(const Hierarchy& hierarchy, Solution* solution) noexcept;

 private:
  struct LevelRows {
    /// Violation of the nearer bound; negative if met.
    Eigen::VectorXd violation;
    Eigen::VectorXd size;    ///< |C_i| |y| + |bound|.
    Eigen::VectorXd value;   ///< C_i y.
    Eigen::VectorXd norm;    ///< |C_i|.
    std::vector<Side> side;  ///< The nearer bound.
  };
  void AddToGradient(const double* row, Span span, double factor, double size);
  void JudgeRows(const Hierarchy& hierarchy, int level,
                 const Solution& solution, Certificate* certificate);
  void JudgeMultipliers(const Hierarchy& hierarchy, int level,
                        const Solution& solution, Certificate* certificate);
  void JudgeLevel(const Hierarchy& hierarchy, int level,
                  const Solution& solution, Certificate* certificate);
  double FreeChange(const Hierarchy& hierarchy, int level, int i, double mu,
                    double radius) const;
  double Gap(const Hierarchy& hierarchy, int level,
             const Solution& solution) const;
  double SumRounding() const;
  double CostRounding(int level) const;
  double RelativeGap(int level) const;

  std::vector<LevelRows> rows_;
  std::vector<double> cost_, cost_size_, gap_;  ///< By level.
  double farthest_ = 0;  ///< Largest distance of a row of any level from y = 0.
  Eigen::VectorXd gradient_, gradient_size_;
};

}  // namespace poise
