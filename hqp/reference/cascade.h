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

/// The paper's algorithm, literally: a cascade of QPs (5), (6), each in the
/// nullspace (3) that the levels above leave. The reference: readable, not
/// fast.
///
/// Three things are done that the paper does not say. Rows that are violated at
/// their own optimum are equalities for all lower levels: they are counted into
/// Z. And v* is evaluated at the y that is returned, never below zero, so that
/// u = 0 is feasible in the next QP. And where an answer is not certified, since
/// large numbers in y have left their rounding to small ones, the cascade is gone
/// through again, from that y on.
class Cascade {
 public:
  /// @param nullspace  kSvd as in the paper; kCod, a complete orthogonal
  ///                   decomposition, is the cheaper usual choice.
  Cascade(int num_variables, const std::vector<LevelCapacity>& capacity,
          RowSpaceMethod nullspace = RowSpaceMethod::kSvd);

  /// Minimises the levels one after the other; the y of minimum norm where
  /// freedom is left after the last. What is not certified is not called optimal.
  [[nodiscard]] Status Solve(const Hierarchy& hierarchy,
                             Solution* solution) noexcept;

  /// The iterations that a solve may take in all; the levels above the one
  /// where they are spent then hold.
  int max_iterations = 10000;

 private:
  struct RowIndex {
    int level, row;
  };
  struct Carrier {
    int level, row;
    bool is_equality;
  };
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
  Eigen::MatrixXd Z_;  ///< Orthonormal columns: what the levels above leave.
  std::vector<std::vector<Side>> violated_;  ///< By level, at its optimum.
  std::vector<RowIndex> active_;             ///< Of the last QP.
};

}  // namespace poise
