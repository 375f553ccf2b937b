// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/hierarchy.h"

namespace poise {

/// How a solve ended.
enum class Status {
  kOptimal,
  /// No certified optimum: the levels above failed_level are optimal.
  kIterationLimit,
  /// NaN or infinity in the rows, see CheckInput(); y is zero. Solver and
  /// Cascade also refuse numbers with which their answer overflows;
  /// failed_level is then 0.
  kNotFinite,
  /// lower > upper, a negative weight, or too many rows; y is zero.
  kBadInput,
};

/// The active bound of a row lower <= C y <= upper at y.
enum class Side : signed char { kNone = 0, kLower = -1, kUpper = 1 };

/// The multipliers that level k's optimum puts on the rows of a level j < k.
/// Two-sided rows: positive at upper, negative at lower.
struct LevelMultipliers {
  Eigen::VectorXd equality;
  Eigen::VectorXd inequality;
};

/// The answer for one level.
struct LevelSolution {
  double cost;  ///< 1/2 (sum weight r^2 + |slack|^2).
  /// Bound of Certifier::gap(). Each solver stores it with the certificate. It
  /// is infinite below failed_level, and on all levels if the hierarchy is
  /// invalid.
  double gap;
  Eigen::VectorXd equality_residual;  ///< B y + b.
  Eigen::VectorXd slack;              ///< max(lower - C y, C y - upper, 0).
  std::vector<Side> active;           ///< By inequality row.
  /// Number of variables minus the rank of the equalities of positive weight
  /// and the violated rows of this level and the levels above; -1 if the solver
  /// did not look for it.
  int nullity;
  std::vector<LevelMultipliers> multipliers;  ///< By level above this one.
  /// The direction p in which this level would move y if `traded_level`, above
  /// it, were relaxed. On the rows of that level, W B p = lambda, and C p = mu
  /// for rows with a slack, up to a multiple of the residuals and slacks. On
  /// active rows above that level, B p = 0 and C p = 0. p sharpens
  /// Certifier::gap().
  Eigen::VectorXd trade_off;
  int traded_level;  ///< -1: there is no trade_off.
};

/// The optimality error of an answer: the worst residual of each kind over all
/// levels. Each residual is relative to the magnitudes of its terms, so
/// rounding gives about 1e-15 in any units. NaN counts as infinity.
///
/// With w_k = B_k y + b_k, v_k the violations of level k, W_k the weights, and
/// lambda_kj, mu_kj the multipliers that level k puts on the rows of j < k:
struct Certificate {
  /// Largest entry of the gradient of level k's Lagrangian,
  ///     g_k = B_k' W_k w_k + C_k' v_k
  ///           + sum_{j<k} (B_j' lambda_kj + C_j' mu_kj),
  /// relative to the same sum of absolute values.
  double stationarity = 0;

  /// Difference of the reported residuals and slacks from those of y.
  double feasibility = 0;

  /// Multipliers of the wrong sign at a bound, on an inactive row, or on an
  /// equality of weight 0. A row is at its bound within 1e-9 (|C_i| |y| +
  /// |bound|). Beyond that it is violated and its multiplier is free.
  double complementarity = 0;

  /// Error of the reported cost: |cost_k - c_k| / (c_k + 1e-9 s_k). Here cost_k
  /// is the reported cost, and the cost at y is
  ///     c_k = (w_k' W_k w_k + |v_k|^2) / 2.
  /// s_k is c_k with |B_i| |y| + |b_i| in place of each entry of w, and |C_i|
  /// |y| + |bound| in place of each entry of v.
  double priority = 0;

  /// Largest Certifier::gap() of the certified levels, relative to c_k + 1e-9
  /// s_k. It is a bound, not an error, and is not part of worst().
  double relative_gap = 0;

  /// The largest of the first four.
  double worst() const noexcept;
};

/// The answer of a solve, sized for a hierarchy's capacity. Only the first
/// num_equalities(level) or num_inequalities(level) entries of a level are
/// used.
struct Solution {
  explicit Solution(int num_variables,
                    const std::vector<LevelCapacity>& capacity);

  /// Restores the initial state: y, multipliers and certificate are zero.
  void Reset() noexcept;

  /// Restores the initial state of this hierarchy's rows and levels only. That
  /// takes less time.
  /// pre: the hierarchy is within the capacity.
  void Reset(const Hierarchy& hierarchy) noexcept;

  Status status;
  /// First level without an optimum, or with invalid numbers; -1 if optimal. If
  /// only the minimum norm is missing, this is the last level (Solver) or the
  /// number of levels (Cascade).
  int failed_level;
  int iterations;     ///< Factorisations and updates of the search.
  Eigen::VectorXd y;  ///< num_variables; if optimal, the shortest optimum.
  std::vector<LevelSolution> levels;

  /// Certificate of the levels above failed_level, or of all levels. Each
  /// solver fills it before it returns.
  Certificate certificate;
};

/// Fills cost, residual and slack of a level at solution->y.
void EvaluateLevel(const Hierarchy& hierarchy, int level,
                   Solution* solution) noexcept;

/// Checks the numbers of the hierarchy. Returns kNotFinite if a number is NaN
/// or infinite; but a lower bound may be -inf, and an upper bound +inf. It also
/// returns kNotFinite if the square of a row's sum of absolute entries
/// overflows, which is the case above 1.3e154, or that square times the row's
/// weight. Returns kBadInput if lower > upper or a weight is negative, else
/// kOptimal. Sets *failed_level to the first level with an error, or to -1.
Status CheckInput(const Hierarchy& hierarchy, int* failed_level) noexcept;

}  // namespace poise
