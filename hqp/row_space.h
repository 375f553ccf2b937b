// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// How the reference solver splits space.
enum class RowSpaceMethod {
  kSvd,  ///< Singular value decomposition, as in the paper.
  kCod,  ///< Orthogonal decomposition with pivoting, the cheaper usual choice.
};

/// Below this a row, scaled to unit length, counts as dependent on others: far
/// above what projections leave of a dependent row (1e-15 or so), far below any
/// row that a robot not at a singularity gives. Both solvers use it.
constexpr double kRankTolerance = 1e-11;

/// What the rows of a matrix span, and what they leave.
struct RowSpace {
  int rank;
  Eigen::MatrixXd V;  ///< Orthonormal; the first `rank` columns span the rows.
};

/// Splits the space of the rows of M, which should be of unit length before any
/// projection: singular values below kRankTolerance count as zero.
RowSpace MakeRowSpace(const Eigen::MatrixXd& M, RowSpaceMethod method);

}  // namespace poise
