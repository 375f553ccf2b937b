// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/reference/row_space.h"
#include "poise/hqp/solution.h"

namespace poise {

/// The reference treats a gradient, multiplier or slope as zero if it is below
/// this, relative to the magnitudes that it is a sum of. Fifty times the
/// rounding of a sum of a hundred terms.
constexpr double kNegligible = 1e-12;

/// The QP of one level of the cascade, (5), (6), in the coordinates z of what
/// the levels above leave:
///     min 1/2 |M z + m|^2 + 1/2 |s|^2
///     lower - s <= P z + value <= upper + s   for the level's own rows (soft)
///     lower     <= P z + value <= upper       for inherited rows
/// with s = 0 wherever it can be. z = 0 must satisfy the inherited rows.
struct LevelQp {
  Eigen::MatrixXd M;
  Eigen::VectorXd m;
  Eigen::VectorXd M_norm;  ///< Norms of the rows before projection.
  Eigen::VectorXd M_size;  ///< What m is added up from, as `size`.
  Eigen::MatrixXd P;
  Eigen::VectorXd value, lower, upper;
  Eigen::VectorXd P_norm;
  Eigen::VectorXd size;  ///< By row at z = 0: rounding is relative to this.
  std::vector<bool> soft;

  /// In: of soft rows, the side of each that is violated at z, and a guess for
  /// others. Out: active.
  std::vector<Side> side;
  Eigen::VectorXd z;
};

/// Solves it by a primal active-set method; after 10 iterations a row, by Bland's
/// rule, which cannot cycle but for rounding: by it no row leaves more than 10
/// times, and what stays for that a certificate may have to judge. So it ends
/// within 31 iterations a row and one. Returns the iterations, or -1 if more than
/// max_iterations were needed: z is then feasible, not optimal.
int SolveLevelQp(RowSpaceMethod method, int max_iterations, LevelQp* qp);

}  // namespace poise
