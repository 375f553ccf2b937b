// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// How the reference solver splits space.
enum class RowSpaceMethod {
  kSvd,  ///< Singular value decomposition, as in the paper.
  kCod,  ///< Orthogonal decomposition with pivoting, the cheaper usual choice.
};

/// What the rows of a matrix span, and what they leave.
struct RowSpace {
  int rank;
  Eigen::MatrixXd V;  ///< Orthonormal; the first `rank` columns span the rows.
};

/// Splits the space of the rows of M, which should be of unit length before any
/// projection: what is not above kRankTolerance (math/rank.h) of it, singular
/// values or what is left of rows, counts as zero.
RowSpace MakeRowSpace(const Eigen::MatrixXd& M, RowSpaceMethod method);

}  // namespace poise
