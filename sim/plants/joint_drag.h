// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"

namespace poise {

/// The damping d and dry friction f of a model's joints as torques, for a plant
/// that has none: implicit, so that no damping is too large for a light link.
///
/// With D = diag(d + f / max(|v|, v_0)), the end of a step has the velocity of
///     (M + dt D) v̇ + N + D v = S' tau + J' F,
/// and the drag is -D (v + dt v̇), which brings a joint to rest but never turns
/// it round. F is what pressed on the feet in the last step.
class JointDrag {
 public:
  JointDrag(const Robot& robot, double dt);

  /// Whether the model has any.
  bool exists() const { return exists_; }

  /// The drag over the step that begins in a state, under torques tau. Costs a
  /// ComputeTick() and a Cholesky decomposition.
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
