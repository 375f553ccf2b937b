// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/reference/row_space.h"
#include "poise/hqp/solution.h"

namespace poise {

/// A gradient, multiplier or slope of the reference is zero if it is below
/// this, relative to the magnitudes of its terms. Fifty times the rounding of a
/// sum of a hundred terms. Ten times larger,
/// WeightsTest.GiveBothSolversTheSameOptimum fails. Ten times smaller, 17
/// instead of 18 of 3000 hierarchies with rows from 1e-3 to 1e6 fail.
constexpr double kNegligible = 1e-12;

/// The QP of one level of the cascade, (5), (6), in coordinates z of the
/// nullspace of the levels above:
///     min 1/2 |M z + m|^2 + 1/2 |s|^2
///     lower - s <= P z + value <= upper + s   for the level's own rows (soft)
///     lower     <= P z + value <= upper       for inherited rows
/// The initial z must satisfy the inherited rows.
struct LevelQp {
  Eigen::MatrixXd M;
  Eigen::VectorXd m;
  Eigen::VectorXd M_norm;  ///< Norms of the rows before projection.
  Eigen::VectorXd M_size;  ///< Magnitude of the terms of m, as `size`.
  Eigen::MatrixXd P;
  Eigen::VectorXd value, lower, upper;
  Eigen::VectorXd P_norm;
  Eigen::VectorXd size;  ///< Magnitude of a row's terms at z = 0.
  std::vector<bool> soft;

  /// In: the initial working set. A soft row that z violates must be in it;
  /// other soft rows may be. Out: the working set at the optimum.
  std::vector<Side> side;
  Eigen::VectorXd z;
};

/// Solves the QP by a primal active-set method. After 10 iterations per row,
/// Bland's rule selects the row to remove; it cannot cycle in exact arithmetic.
/// Rounding could still cause a cycle, so Bland's rule removes a row at most 10
/// times. The search thus ends within 31 iterations per row, plus one. A row
/// kept by this limit can make z suboptimal, which the certificate shows.
///
/// Returns the number of iterations, or -1 if max_iterations did not suffice; z
/// is then feasible, but not optimal.
int SolveLevelQp(RowSpaceMethod method, int max_iterations, LevelQp* qp);

}  // namespace poise
