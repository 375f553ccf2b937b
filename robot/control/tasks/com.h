// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/dynamics/tree.h"
#include "poise/robot/control/com_gains.h"
#include "poise/robot/control/task.h"

namespace poise {

/// Brings the center of mass G to its reference, the linear half of
/// MomentumTask:
///     (H_G v̇ + bias)_linear / m = kp (p_ref - p_G) + kd (v_ref - v_G) + a_ref
/// plus the correction of Disturbance, as in MomentumTask.
class ComTask final : public Task {
 public:
  /// Parameters: kp (30 1/s2), kd (10 1/s), ki and ki_height (15 and 60 1/s3),
  /// see Disturbance.
  explicit ComTask(const Tree& tree);
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

  const ComGains& gains() const { return gains_; }

 private:
  double mass_;
  ComGains gains_;
};

}  // namespace poise
