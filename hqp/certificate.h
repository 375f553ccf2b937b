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
    std::vector<Side> side;  ///< The nearer bound.
  };
  void JudgeRows(const Hierarchy& hierarchy, int level,
                 const Solution& solution, Certificate* certificate);
  void JudgeMultipliers(const Hierarchy& hierarchy, int level,
                        const Solution& solution, Certificate* certificate);

  std::vector<LevelRows> rows_;
  Eigen::VectorXd gradient_, gradient_size_;
};

}  // namespace poise
