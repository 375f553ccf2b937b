// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/easing/ramp.h"

namespace poise {

/// Eases rows that were changed between two ticks into what they ask for. Each
/// row has an offset,
///     B y + b = offset,    lower - offset <= C y <= upper + offset,
/// and so has y, which is its offset in what the rows leave free. A change adds as
/// much to them as lets the last y be the optimum of the changed rows, too, and
/// Ramp brings them to zero; so y, and the torques of it, go from the one
/// hierarchy to the other without a jump, and every level is still strict. What
/// else asks for something new, a push or a reference, is not held back: only
/// what was changed is.
///
/// Where limits of a level that was changed are violated, what else is asked for in
/// that level may still jump: their slacks pull as before, but equalities are eased.
///
/// (Intermediate desired values, as of Lee, Mansard and Park, 2012, but of the
/// last solution instead of a second one.)
class Easing {
 public:
  explicit Easing(int num_variables);

  /// Makes room for the rows of a task and returns where it begins: at `rows`
  /// below. Allocates.
  int AddTask(int equalities, int inequalities);

  /// Sets the duration of a ramp, s. 0 switches ramps off and ends running ones.
  void set_duration(double seconds) noexcept;

  /// A tick of dt has found y; Remember() follows, for each task that took part:
  /// what is left of its equalities, and of its inequalities times a scale.
  void Advance(double dt, const Eigen::VectorXd& y) noexcept;
  void Remember(int rows, const Eigen::Ref<const Eigen::VectorXd>& residual,
                const Eigen::Ref<const Eigen::VectorXd>& slack,
                double scale) noexcept;

  /// Ends all ramps. The next tick has no last y.
  void End() noexcept;

  /// Whether there is a y to begin at, and time to ease.
  bool IsPossible() const { return dt_ > 0 && ramp_.duration() > 0; }
  bool is_on() const { return ramp_.is_on(); }
  /// Whether y is held in what the rows leave free.
  bool holds() const { return is_on() && holds_; }

  /// These five add offsets after a change; `rows` is where a task begins, as
  /// AddTask() said, and `now` its rows as they are after the change.
  ///
  /// For equalities that were not there in the last tick: the last y meets them.
  void BeginAtLast(int rows, const EqualityBlock& now) noexcept;
  /// For equalities that were `before`, of a task that weighed weight_ratio times
  /// as much: they draw at the last y as they did.
  void BeginAsBefore(int rows, const EqualityBlock& now,
                     const EqualityBlock& before, double weight_ratio) noexcept;
  /// For equalities that the last y missed, where what kept it from them may be
  /// gone: their offsets grow by what it missed, and so it meets them.
  void KeepResiduals(int rows, int equalities) noexcept;
  /// For what the rows leave free, where rows that determined it may be gone: y
  /// is held where it was.
  void KeepFree() noexcept;
  /// For inequalities: the last y violates them by no more than it did.
  void BeginInside(int rows, int equalities,
                   const InequalityBlock& now) noexcept;

  /// Moves right sides by their offsets. Do not allocate.
  void Ease(int rows, EqualityBlock* equalities) const noexcept;
  void Ease(int rows, int equalities,
            InequalityBlock* inequalities) const noexcept;
  /// Writes the rows y = offset, of a level below all others.
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
