// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/row_sums.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Computes the certificate of an answer from (levels, y, multipliers) alone.
/// It shares no code with the solvers.
class Certifier {
 public:
  Certifier(int num_variables, const std::vector<LevelCapacity>& capacity);

  /// Allocates memory for `max_inequalities` inequalities, which the levels
  /// share. pre: the judged levels of a hierarchy do not have more together.
  Certifier(int num_variables, const std::vector<LevelCapacity>& capacity,
            int max_inequalities);

  /// Certifies all levels, or those above solution.failed_level if there is
  /// one. Does not read solution.certificate. Cost: about 6 flops for each
  /// entry in the span of a row, 4 more in equalities and violated rows, and 4
  /// for each entry and nonzero multiplier. A level that cannot be met takes up
  /// to four more products of y or a direction with its rows, and with those
  /// above. Does not allocate.
  Certificate Certify(const Hierarchy& hierarchy,
                      const Solution& solution) noexcept;

  /// Certifies the answer and stores its certificate and gaps in it.
  void Certify(const Hierarchy& hierarchy, Solution* solution) noexcept;

  /// After Certify() or Truncate(): how far the cost of a level may be above
  /// its optimum, given the levels above, in the unit of the cost. After
  /// Truncate(), this is the whole cost for failed_level, and infinite below
  /// it; after Certify(), it is infinite from failed_level on. It holds for all
  /// optima of the levels above that are no farther from y than 2 (|y| +
  /// largest distance from y = 0 of an equality or violated row, up to this
  /// level), if y meets these levels but for rounding: multipliers at y stand
  /// for those at the optimum. It contains the rounding of the cost and of the
  /// gradient, and but for this rounding, it never exceeds the cost.
  /// docs/hqp-gap.md derives it.
  double gap(int level) const { return gap_[static_cast<size_t>(level)]; }

  /// Upper limit of Certificate::worst() for an answer with status kOptimal.
  static constexpr double kCertified = 1e-9;

  /// Certifies the levels up to failed_level in order, and stores certificate
  /// and gaps in the answer. The first level with which worst() exceeds
  /// kCertified becomes failed_level, and the status kIterationLimit.
  void Truncate(const Hierarchy& hierarchy, Solution* solution) noexcept;

 private:
  /// An inequality at y.
  struct Inequality {
    double violation;  ///< Excess over the nearer bound; negative if met.
    double size;       ///< |C_i| |y| + |bound|.
    double value;      ///< C_i y.
    double norm;       ///< |C_i|.
    double rounding;   ///< Largest error of the violation by rounding.
    Side side;         ///< The nearer bound.
  };
  /// Sums over the rows of a level.
  struct CostSums {
    double cost = 0;
    double size = 0;      ///< Cost of the magnitudes of its terms.
    double rounding = 0;  ///< Rounding of the cost.
    /// Sum of weight times rounding^2 of all residuals and slacks.
    double slack_rounding = 0;
    double feasibility = 0;  ///< See Certificate.
  };
  const Inequality* inequalities(int level) const {
    return inequalities_.data() + first_inequality_[static_cast<size_t>(level)];
  }
  void StoreGaps(int num_levels, Solution* solution) const;
  void AddToGradient(const double* rows, const Span* spans, int count);
  void JudgeRows(const Hierarchy& hierarchy, int level,
                 const Solution& solution, Certificate* certificate);
  /// Judges the equalities of a level: adds them to its sums and its gradient,
  /// and sets residual_ and farthest_. JudgeInequalities() does so for its
  /// inequalities.
  void JudgeEqualities(const Hierarchy& hierarchy, int level,
                       const Solution& solution, CostSums* total);
  void JudgeInequalities(const Hierarchy& hierarchy, int level,
                         const Solution& solution, CostSums* total);
  void JudgeMultipliers(const Hierarchy& hierarchy, int level,
                        const Solution& solution, Certificate* certificate);
  void JudgeLevel(const Hierarchy& hierarchy, int level,
                  const Solution& solution, Certificate* certificate);
  // The gap, in gap.cc.
  double CostScale(int level) const;
  double RelativeGap(int level) const;
  void FindGap(const Hierarchy& hierarchy, int level, const Solution& solution);
  double PreciseGradientNorm(const Hierarchy& hierarchy, int level,
                             const Solution& solution);
  bool IsInside(int level, int i) const;
  double LargestGain(const Hierarchy& hierarchy, int level, int above,
                     double radius, const Solution& solution);
  void FindChange(int level);
  void SharpenChanges(const Hierarchy& hierarchy, int level,
                      const Solution& solution);
  void FindNormsOfMultipliers(const Hierarchy& hierarchy, int level,
                              const Solution& solution);
  double FreeChange(const Hierarchy& hierarchy, int level, int above, int i,
                    double mu, double radius, double norm_y,
                    const Solution& solution) const;
  void FindSums(const Hierarchy& hierarchy, int level,
                const Eigen::VectorXd* p);
  template <typename Use>
  void ForEachSlack(const Hierarchy& hierarchy, int level, int above,
                    const Solution& solution, const Use& use) const;
  double GainOfSlacks(const Hierarchy& hierarchy, int level, int above,
                      const Eigen::VectorXd* p, const Solution& solution);
  double LargestStep(const Hierarchy& hierarchy, int level,
                     const Eigen::VectorXd& p, const Solution& solution,
                     double* slope) const;

  std::vector<Eigen::VectorXd> residual_;  ///< By level: B y + b.
  std::vector<Inequality> inequalities_;   ///< All judged levels, in order.
  std::vector<int> first_inequality_;      ///< By level: where its rows begin.
  std::vector<RowSums> sums_;  ///< By row of one block, or one level.
  /// By row of one block: what AddToGradient() multiplies it with.
  std::vector<double> factor_, size_;
  /// By level: the cost, the cost of the magnitudes of its terms, and its
  /// rounding.
  std::vector<double> cost_, cost_size_, cost_rounding_;
  /// By level: norm of the rounding of all residuals and slacks, each times the
  /// root of its weight.
  std::vector<double> slack_rounding_;
  /// By level: norm of the gradient of its Lagrangian, and its rounding.
  std::vector<double> error_;
  std::vector<double> gap_;  ///< By level.
  /// By level: gap_, or the cost in exact arithmetic if that is smaller and
  /// known.
  std::vector<double> exact_gap_;
  /// By level: how far the cost may be below its optimum, because y misses the
  /// levels above.
  std::vector<double> undercut_;
  /// By level: largest change of all residuals and slacks from y to an optimum,
  /// each times the root of its weight.
  std::vector<double> change_;
  /// By level and level above: norm of the multipliers that the level puts on
  /// the rows above, each divided by the root of the row's weight.
  Eigen::MatrixXd multiplier_norm_;
  std::vector<bool> is_sharp_;  ///< See SharpenChanges().
  double farthest_ = 0;  ///< Largest distance of a row of any level from y = 0.
  Eigen::VectorXd gradient_, gradient_size_;
  int num_terms_ = 0;  ///< Rows that have been added to gradient_.
  std::vector<long double> precise_gradient_;
};

}  // namespace poise
