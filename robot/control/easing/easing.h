// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/easing/ramp.h"

namespace poise {

/// Ramps of rows that were changed between two ticks. Each row has an offset,
///     B y + b = offset,    lower - offset <= C y <= upper + offset,
/// and y has an offset in the nullspace of the rows. A change adds offsets with which
/// the last y is an optimum of the changed rows, and Ramp brings the offsets to zero.
/// So y and its torques change without a jump, and every level stays strict. Only
/// changed rows are delayed; pushes and references act at once.
///
/// If limits of a changed level are violated, other rows of that level may still
/// jump: the slacks of the limits keep their pull, but equalities have offsets.
///
/// Source: the intermediate desired values of Lee, Mansard and Park, 2012, applied
/// to the last solution instead of a second one.
class Easing {
 public:
  explicit Easing(int num_variables);

  /// Reserves rows for a task and returns their first index, `rows` below.
  /// Allocates.
  int AddTask(int equalities, int inequalities);

  /// Sets the duration of a ramp, s. 0 switches ramps off and ends running ones.
  void set_duration(double seconds) noexcept;

  /// Stores y of a tick of length dt. Call Remember() afterwards for each active
  /// task, with the residuals of its equalities and scaled inequalities.
  void Advance(double dt, const Eigen::VectorXd& y) noexcept;
  void Remember(int rows, const Eigen::Ref<const Eigen::VectorXd>& residual,
                const Eigen::Ref<const Eigen::VectorXd>& slack,
                double scale) noexcept;

  /// Ends all ramps. The next tick has no last y.
  void End() noexcept;

  /// Returns whether there is a last y and a positive duration.
  bool IsPossible() const { return dt_ > 0 && ramp_.duration() > 0; }
  bool is_on() const { return ramp_.is_on(); }
  /// Returns whether y has an offset in the nullspace of the rows.
  bool holds() const { return is_on() && holds_; }

  /// The next five functions add offsets after a change. `rows` is the result of
  /// AddTask() for the task, and `now` has its rows after the change.
  ///
  /// For new equalities: the last y meets them with the offset.
  void BeginAtLast(int rows, const EqualityBlock& now) noexcept;
  /// For equalities that had the values `before` and weight_ratio times the present
  /// weight: they keep their pull on the last y.
  void BeginAsBefore(int rows, const EqualityBlock& now,
                     const EqualityBlock& before, double weight_ratio) noexcept;
  /// For equalities with a residual at the last y, after a change of rows above them:
  /// their offsets grow by the residual, so that the last y meets them.
  void KeepResiduals(int rows, int equalities) noexcept;
  /// For the nullspace of the rows, after rows were removed: y keeps its last value
  /// there.
  void KeepFree() noexcept;
  /// For inequalities: the last y does not violate them more than before.
  void BeginInside(int rows, int equalities,
                   const InequalityBlock& now) noexcept;

  /// Adds the offsets to right sides and bounds. Does not allocate.
  void Ease(int rows, EqualityBlock* equalities) const noexcept;
  void Ease(int rows, int equalities,
            InequalityBlock* inequalities) const noexcept;
  /// Writes the rows y = offset of the last level.
  void Hold(EqualityBlock* equalities) const noexcept;

 private:
  // Offsets of y, then of each task: equalities, lower bounds and upper bounds of
  // its inequalities.
  Ramp ramp_;
  Eigen::VectorXd lacked_;  // Residual of each in the last tick.
  Eigen::VectorXd y_last_;
  double dt_ = 0;  // Period of the last tick; 0 before it.
  bool holds_ = false;
};

}  // namespace poise
