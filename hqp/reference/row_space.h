// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// Method by which the reference solver computes a row space.
enum class RowSpaceMethod {
  kSvd,  ///< Singular value decomposition, as in the paper.
  kCod,  ///< Orthogonal decomposition with pivoting, the cheaper usual choice.
};

/// Orthonormal bases of the row space and the nullspace of a matrix.
struct RowSpace {
  int rank;
  Eigen::MatrixXd V;  ///< Orthonormal; the first `rank` columns span the rows.
};

/// Computes the row space of M, whose rows should have had unit norm before any
/// projection. A singular value (kSvd) or a remainder of a row (kCod) of at
/// most kRankTolerance (math/rank.h) counts as zero.
RowSpace MakeRowSpace(const Eigen::MatrixXd& M, RowSpaceMethod method);

}  // namespace poise
