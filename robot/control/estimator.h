// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"

namespace poise {

/// Estimates the state of the base from what a robot senses: the orientation
/// and the gyroscope of the inertial unit, its accelerometer, and the joints of
/// the legs whose feet stand still.
///
/// A foot in contact stays where it was when it touched down, p_WC: with the
/// orientation R_WB of the inertial unit,
///     p_WB = p_WC - R_WB p_BC(q),       v_WB = -(w x R_WB p_BC + R_WB v_BC),
/// the mean over the feet, each by its normal force. The accelerometer carries
/// the velocity between, and through a flight, as
///     v+ = v + dt (R_WB f + g),  then  v+ += dt / tau (v_legs - v+).
/// The heading is as good as that of the inertial unit.
///
/// A measurement whose stamp, inertial unit or joints are not finite, or beyond
/// 1e6, is not used. The state then has the base and the stamp of the last one
/// that was, and the joints of this one, as they are; the next good measurement
/// bridges the gap. So a joint that is not finite reaches the controller, which
/// fails safe at once; and if nothing good is heard of the base, the state's stamp
/// stands still, and the controller fails safe after its usual time for that. A
/// foot whose force is not finite counts as unloaded.
class Estimator {
 public:
  /// @param velocity_time  tau, s: smaller trusts the legs, larger the
  ///                       accelerometer.
  explicit Estimator(const Robot& robot, double velocity_time = 0.01);

  /// Begins where the base is known to be: X_WB and V_WB_W of the measurement
  /// are believed once, here, and never after. pre: all of it is finite.
  void Start(const Measurement& measurement);

  /// Fills state from a measurement; does not read its X_WB and V_WB_W.
  /// pre: state has the sizes of the tree. Does not allocate.
  void Update(const Measurement& measurement, State* state) noexcept;

 private:
  // Computes each foot's contact frame for the base X_WB = (R_WB, 0) with twist
  // (w, 0).
  void ComputeFeet(const Measurement& measurement, State* state) noexcept;

  Robot robot_;
  double velocity_time_;
  Tick tick_;
  struct FootState {
    bool in_contact = true;
    Eigen::Vector3d p_WC;    // Where it stands.
    Eigen::Vector3d p_BC_W;  // Where the leg has it.
    Eigen::Vector3d v_BC_W;  // How the leg and the base's rotation move it.
  };
  std::vector<FootState> feet_;
  Eigen::Vector3d p_WB_;
  Eigen::Vector3d v_WB_;
  Eigen::Matrix<double, 7, 1> q_base_;  // From the last accepted measurement.
  Eigen::Matrix<double, 6, 1> v_base_;
  double time_ = 0;
};

}  // namespace poise
