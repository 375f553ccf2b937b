// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hqp/hierarchy.h"
#include "hqp/solution.h"

namespace poise {

/// How far an answer is from optimal, level by level: the worst of each kind,
/// relative to what the residual is added up from, so that rounding gives about
/// 1e-15 whatever the scales; infinity where anything is NaN.
///
/// With w_k = B_k y + b_k, v_k the violations of level k, W_k the weights, and
/// lambda_kj, mu_kj the multipliers that level k puts on the rows of j < k:
struct Certificate {
  /// g_k = B_k' W_k w_k + C_k' v_k + sum_{j<k} (B_j' lambda_kj + C_j' mu_kj),
  /// relative to the same sum of absolute values.
  double stationarity = 0;

  /// Residuals and slacks reported against those of y.
  double feasibility = 0;

  /// Multipliers of the wrong sign at a bound, or on a row with a gap. A row is
  /// at its bound within 1e-9 (|C_i| |y| + |bound|), violated above that, and
  /// then its multiplier is free.
  double complementarity = 0;

  /// |cost_k - c_k| / (c_k + 1e-9 s_k), where cost_k is the one reported,
  ///     c_k = (w_k' W_k w_k + |v_k|^2) / 2
  /// that of y, and s_k what c_k would be if each w were |B_i| |y| + |b_i|, and each
  /// v were |C_i| |y| + |bound|, added up from magnitudes.
  double priority = 0;

  /// The worst of the four.
  double worst() const;
};

/// Computes the certificate of an answer from (levels, y, multipliers) alone:
/// it shares nothing with the solvers.
class Certifier {
 public:
  Certifier(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Judges all levels, or those above solution.failed_level if there is one.
  /// Costs some 4 n flops a row, and as many a nonzero multiplier. Does not
  /// allocate.
  Certificate Certify(const Hierarchy& hierarchy,
                      const Solution& solution) noexcept;

  /// The worst that an answer may have that is called optimal.
  static constexpr double kCertified = 1e-9;

  /// Makes an answer say less, until what it says is certified: failed_level
  /// goes up the levels, and the status is kIterationLimit. Changes nothing if
  /// the answer is certified as it is.
  void Truncate(const Hierarchy& hierarchy, Solution* solution) noexcept;

 private:
  struct LevelRows {
    Eigen::VectorXd violation;  ///< Of the side at work; negative: the gap.
    Eigen::VectorXd size;       ///< |C_i| |y| + |bound|: 1e-9 of it is nothing.
    std::vector<Side> side;     ///< The side at work.
  };
  void JudgeRows(const Hierarchy& hierarchy, int level,
                 const Solution& solution, Certificate* certificate);
  void JudgeMultipliers(const Hierarchy& hierarchy, int level,
                        const Solution& solution, Certificate* certificate);

  std::vector<LevelRows> rows_;
  Eigen::VectorXd abs_y_, gradient_, gradient_size_;
};

}  // namespace poise
