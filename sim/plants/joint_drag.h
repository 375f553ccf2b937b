// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"

namespace poise {

/// Computes damping d and dry friction f of joints as torques, for a plant without
/// them. The torques are implicit, so that any damping is stable for a light link.
///
/// With D = diag(d + f / max(|v|, v_0)), the end of a step has the velocity of
///     (M + dt D) v̇ + N + D v = S' tau + J' F,
/// and the drag is -D (v + dt v̇). The drag brings a joint to rest and never reverses
/// it. F has the contact wrenches of the last step.
class JointDrag {
 public:
  JointDrag(const Robot& robot, double dt);

  /// Returns whether the model has damping or friction.
  bool exists() const { return exists_; }

  /// Returns the drag of the step that begins in a state, with torques tau. Costs a
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
