// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/level_qp.h"
#include "poise/hqp/reference/row_space.h"
#include "poise/hqp/solution.h"

namespace poise {

/// Cascade solves the hierarchy as the paper does: a cascade of QPs (5), (6),
/// each in the nullspace (3) of the levels above. It is the reference, written
/// to be read, not to be fast.
///
/// Three points are not in the paper. Rows that are violated at the optimum of
/// their own level are equalities for all lower levels, and count in Z. The
/// violation v* is that of the returned y and never negative, so that u = 0 is
/// feasible in the next QP. If the answer is not certified, because rounding of
/// large entries of y is left in small ones, the cascade is repeated from that
/// y.
class Cascade {
 public:
  /// @param nullspace  kSvd is the paper's choice; kCod, a complete orthogonal
  ///                   decomposition, is cheaper.
  Cascade(int num_variables, const std::vector<LevelCapacity>& capacity,
          RowSpaceMethod nullspace = RowSpaceMethod::kSvd);

  /// Minimises the levels one after the other. If several y are optimal on all
  /// levels, it returns the one of minimum norm. kOptimal implies a certificate
  /// of at most 1e-9.
  [[nodiscard]] Status Solve(const Hierarchy& hierarchy,
                             Solution* solution) noexcept;

  /// Largest number of iterations of all QPs of a solve. If they are spent, the
  /// levels above failed_level are optimal.
  int max_iterations = 10000;

 private:
  struct RowIndex {
    int level, row;
  };
  struct Carrier {
    int level, row;
    bool is_equality;
  };
  Status Refuse(const Hierarchy& hierarchy, Status status, int failed_level,
                Solution* solution);
  void SolveFromY(const Hierarchy& hierarchy, Solution* solution);
  bool SolveLevel(const Hierarchy& hierarchy, int level, Solution* solution);
  std::vector<RowIndex> FindRows(const Hierarchy& hierarchy, int level) const;
  void SetCost(const Hierarchy& hierarchy, int level, const Eigen::VectorXd& y,
               LevelQp* qp) const;
  void SetBounds(const Hierarchy& hierarchy, int level,
                 const std::vector<RowIndex>& rows, const Eigen::VectorXd& y,
                 LevelQp* qp) const;
  void FixLevel(const Hierarchy& hierarchy, int level, Solution* solution);
  void FindMultipliers(const Hierarchy& hierarchy, int level,
                       Solution* solution);
  std::vector<Carrier> FindCarriers(const Hierarchy& hierarchy,
                                    int level) const;

  RowSpaceMethod method_;
  Certifier certifier_;
  Eigen::MatrixXd
      Z_;  ///< Orthonormal basis of the nullspace of the levels so far.
  std::vector<std::vector<Side>>
      violated_;  ///< Side violated at the optimum of the row's level.
  std::vector<RowIndex> active_;  ///< Working set of the last QP.
};

}  // namespace poise
