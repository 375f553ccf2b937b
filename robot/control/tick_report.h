// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "poise/hqp/solution.h"
#include "poise/robot/control/command.h"

namespace poise {

/// A row that is active at the solution of a tick. Stack::RowName() returns its
/// name.
struct ActiveRow {
  int task;   ///< Index for Stack::task().
  int row;    ///< Index into Task::inequality_names().
  Side side;  ///< Active bound.
  /// The row's own level if it has a slack, else the first solved level with a
  /// multiplier on the row.
  int pressing_level;
  double multiplier;  ///< Absolute multiplier of pressing_level.
  double slack;       ///< Violation of the row, in the scale of the row.
};

/// Result of one task in a tick.
struct TaskReport {
  bool enabled = false;
  int level = 0;
  /// Norm of the equality residuals, in the scale of the rows. During a ramp
  /// the residuals refer to the eased targets of this tick.
  double residual = 0;
  double slack = 0;  ///< Largest slack of the inequalities.
};

/// A violated equality row.
struct LostRow {
  int task;       ///< Index for Stack::task().
  int row;        ///< Index into Task::equality_names().
  double amount;  ///< Residual times Task::equality_scale().
};

/// Why a tick failed safe.
enum class FailSafeReason {
  kNone,      ///< The tick did not fail safe.
  kState,     ///< The state is invalid.
  kClock,     ///< The state's time stamp stands still.
  kNoAnswer,  ///< No solution meets the dynamics.
};

/// Report on the last tick. Its size is fixed: filling it does not allocate.
struct TickReport {
  TickStatus status = TickStatus::kOk;
  FailSafeReason fail_safe_reason = FailSafeReason::kNone;
  Status solver_status = Status::kOptimal;
  /// Set if the status is kLimitRelaxed: the row of a torque or joint limit
  /// with the largest slack, in the scale of the row. A torque limit also
  /// counts if its task is off and the torque was clamped to the limit.
  std::optional<ActiveRow> relaxed;
  int failed_level = 0;  ///< Priority level that was not solved; 0: none.
  int iterations = 0;    ///< Solver iterations.
  double modelled_seconds = 0;  ///< Solver::modelled_seconds() of this tick, s.
  /// DynamicsResidual() of y; above 1e-9 the tick fails safe.
  double dynamics_residual = 0;
  Eigen::VectorXd y;  ///< [v̇; λ], λ by foot, about and in the axes of C.
  std::vector<TaskReport> tasks;  ///< By task of the stack.
  std::vector<ActiveRow> active;  ///< Its capacity is the number of all rows.
  /// Rows that are violated, except those of the last level.
  std::vector<LostRow> lost;
  Certificate certificate;  ///< Certificate of the solution.
  /// LevelSolution::gap of priority level i + 1. NaN if the hierarchy has no
  /// such level, and if the solver did not run. With one weighted QP, all
  /// levels below the first one are one level of the hierarchy, at the second
  /// one in use.
  std::vector<double> gap;

  /// Resets the numbers of the solution, for a tick in which the solver did not
  /// run.
  void ClearAnswer() noexcept;

  /// Returns λ of a foot, [moment; force]; nv is Tree::nv().
  Eigen::Matrix<double, 6, 1> foot_wrench(int nv, int foot) const {
    return y.segment<6>(nv + 6 * foot);
  }
};

}  // namespace poise
