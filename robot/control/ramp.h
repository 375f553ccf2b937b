// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "hqp/hierarchy.h"

namespace poise {

/// Eases a hierarchy that was changed between two ticks into what it asks for.
/// Of the last tick's y each row knows how far it would be off; of that the next
/// tick keeps the part k:
///     B y + b = k (B y_last + b),
///     C y <= upper + k max(0, C y_last - upper), likewise lower.
/// and what the rows leave free is k y_last. With k = 1 the last y is the optimum
/// of every rank, with k = 0 nothing is eased: the product of all k falls from 1
/// to 0 along a curve of least jerk, so y, and the torques of it, go from the one
/// hierarchy to the other without a jump, and every rank is still strict. (An
/// intermediate desired value as of Lee, Mansard and Park, 2012, but of the last
/// solution instead of a second one.)
class Ramp {
 public:
  explicit Ramp(int num_variables)
      : y_last_(Eigen::VectorXd::Zero(num_variables)) {}

  /// Of a ramp, s; 0, and none begins.
  void set_duration(double seconds) { duration_ = seconds; }

  /// Begins anew; not before there is a y to begin at.
  void Begin() noexcept;

  /// What comes next is not eased, and its y not known yet.
  void End() noexcept;

  /// A tick of dt has found y, finite. pre: y has the size of the variables.
  void Advance(double dt, const Eigen::VectorXd& y) noexcept;

  bool is_on() const { return keep_ > 0; }

  /// Moves the rows' right sides. Do not allocate.
  void Ease(EqualityBlock* equalities) const noexcept;
  void Ease(InequalityBlock* inequalities) const noexcept;

  /// Writes the rows y = k y_last, of a level below all others.
  void Hold(EqualityBlock* equalities) const noexcept;

 private:
  void Choose() noexcept;

  Eigen::VectorXd y_last_;
  double duration_ = 0;
  double dt_ = 0;       // Of the last tick; 0 as long as there is none.
  double elapsed_ = 0;  // Since the ramp began.
  double keep_ = 0;     // Of the next tick.
};

}  // namespace poise
