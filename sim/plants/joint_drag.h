// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"

namespace poise {

/// Computes the damping d and dry friction f of a model's joints as torques,
/// for a plant whose engine does not model them. The computation is implicit,
/// so it is stable for any damping, also of a link with a small mass.
///
/// With D = diag(d + f / max(|v|, v_0)), the acceleration in a step solves
///     (M + dt D) v̇ + N + D v = S' tau + J' F,
/// and the drag is -D (v + dt v̇). The dry part of the drag is at most f: a
/// joint that needs more slips, with f against its motion. The drag stops a
/// joint but never reverses its motion. F are the contact wrenches on the feet
/// in the last step.
class JointDrag {
 public:
  JointDrag(const Robot& robot, double dt);

  /// Returns whether a joint of the model has damping or dry friction.
  bool exists() const { return exists_; }

  /// Returns the drag during the step that begins in a state, under the torques
  /// tau, N m or N. Costs a ComputeTick() and a Cholesky decomposition.
  const Eigen::VectorXd& Compute(const PlantState& state,
                                 const Eigen::VectorXd& tau);

 private:
  Robot robot_;
  double dt_;
  bool exists_ = false;
  Tick tick_;
  Eigen::VectorXd drag_;
};

}  // namespace poise
