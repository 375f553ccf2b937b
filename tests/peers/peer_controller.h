// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"

namespace poise {

/// The inputs of a controller in the comparison. The controller keeps the robot
/// standing where it is in `start`.
struct ControllerSetup {
  const Robot& robot;
  State start;
  bool has_limits;  ///< Whether torques and joint velocities are bounded.
};

/// The answer of a controller in one tick, in Poise's conventions.
struct ControllerAnswer {
  /// [v̇; λ], λ by foot, [moment; force] about and in the axes of C.
  Eigen::VectorXd y;
  /// By joint, N m or N. Empty if it is more than the torque of y.
  Eigen::VectorXd tau;
};

/// A whole-body controller in the comparison. One object controls consecutive
/// ticks.
class PeerController {
 public:
  virtual ~PeerController() = default;

  /// The name in the table, one word.
  virtual const char* name() const = 0;

  /// Copies the state into the controller's own conventions. This step is not
  /// timed.
  virtual void Load(const State& state) = 0;

  /// Computes the joint torques for the loaded state. This step is timed.
  /// Returns whether the controller reports a solution.
  virtual bool Update() = 0;

  /// Returns the answer of the last Update(). This step is not timed.
  virtual ControllerAnswer answer() = 0;
};

/// Makes Poise's controller.
std::unique_ptr<PeerController> MakePoiseController(
    const ControllerSetup& setup);

/// Makes the controllers that this program is built with, Poise's first. Each
/// adapter defines it.
std::vector<std::unique_ptr<PeerController>> MakeControllers(
    const ControllerSetup& setup);

}  // namespace poise
