// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/easing/ramp.h"

namespace poise {

/// Eases changes of tasks: after a change between two ticks, the solution y and
/// the torques move to the new optimum without a jump. Each row has an offset,
///     B y + b = offset,    lower - offset <= C y <= upper + offset.
/// y has an offset as well: rows y = offset, on a level below all others,
/// determine what the other rows leave free. A change adds to the offsets such
/// that the last y is an optimum of the changed rows too. Ramp then brings the
/// offsets to zero. All levels stay strict. A push or a new reference acts in
/// full: only changes of tasks are eased.
///
/// If limits of a changed level are violated, the other rows of this level may
/// still jump: the slacks of the limits act as before, but equalities are
/// eased.
///
/// The method is that of intermediate desired values (Lee, Mansard and Park,
/// 2012), but with the last solution instead of a second one.
class Easing {
 public:
  explicit Easing(int num_variables);

  /// Adds the rows of a task. Returns the index of the first one, the argument
  /// `rows` of the functions below. Allocates.
  int AddTask(int equalities, int inequalities);

  /// Sets the duration of a ramp, s. 0 ends a running ramp and switches easing
  /// off.
  void set_duration(double seconds) noexcept;

  /// Advances the ramp by dt and records y, the solution of this tick. Then
  /// call Remember() for each task with rows: it records the residuals of the
  /// equalities, and the slacks of the inequalities, whose rows were multiplied
  /// by `scale`.
  void Advance(double dt, const Eigen::VectorXd& y) noexcept;
  void Remember(int rows, const Eigen::Ref<const Eigen::VectorXd>& residual,
                const Eigen::Ref<const Eigen::VectorXd>& slack,
                double scale) noexcept;

  /// Ends the ramp and forgets the last y. The next change is not eased.
  void End() noexcept;

  /// Whether a change can be eased: there is a last y, and the duration is not
  /// 0.
  bool IsPossible() const { return dt_ > 0 && ramp_.duration() > 0; }
  bool is_on() const { return ramp_.is_on(); }
  /// Whether the rows of Hold() are needed, see KeepFree().
  bool holds() const { return is_on() && holds_; }

  /// The next five functions add offsets after a change. `rows` is the index
  /// from AddTask(), and `now` holds the rows of the task after the change.
  ///
  /// For equalities that are new in this tick: the last y meets them exactly.
  void BeginAtLast(int rows, const EqualityBlock& now) noexcept;
  /// For equalities that were `before` in the last tick, when the weight of the
  /// task was weight_ratio times the present one: weight times residual at the
  /// last y stays the same.
  void BeginAsBefore(int rows, const EqualityBlock& now,
                     const EqualityBlock& before, double weight_ratio) noexcept;
  /// For equalities that the last y did not meet, if the rows that prevented
  /// this may have changed: the offsets grow by the residuals, so that the last
  /// y meets the equalities.
  void KeepResiduals(int rows, int equalities) noexcept;
  /// For the variables that the rows leave free, if rows that determined them
  /// may have been removed: Hold() keeps y at its last value.
  void KeepFree() noexcept;
  /// For inequalities: the last y violates them at most as much as before.
  void BeginInside(int rows, int equalities,
                   const InequalityBlock& now) noexcept;

  /// Shift the right-hand sides by their offsets. Do not allocate.
  void Ease(int rows, EqualityBlock* equalities) const noexcept;
  void Ease(int rows, int equalities,
            InequalityBlock* inequalities) const noexcept;
  /// Writes the rows y = offset for a level below all others.
  void Hold(EqualityBlock* equalities) const noexcept;

 private:
  // Offsets of y, then of each task: its equalities, the lower bounds of its
  // inequalities, and the upper bounds.
  Ramp ramp_;
  // Residuals and slacks of the last tick, in the same order.
  Eigen::VectorXd lacked_;
  Eigen::VectorXd y_last_;
  double dt_ = 0;  // Duration of the last tick, s; 0 if there is none.
  bool holds_ = false;
};

}  // namespace poise
