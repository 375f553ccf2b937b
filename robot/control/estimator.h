// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"

namespace poise {

/// Estimates the state of the base from the sensors of a robot: orientation,
/// gyroscope and accelerometer of the inertial unit, and the joints of the legs
/// whose feet are in contact.
///
/// A foot in contact is assumed to stay at its touchdown position p_WC. With
/// the orientation R_WB of the inertial unit,
///     p_WB = p_WC - R_WB p_BC(q),       v_WB = -(w x R_WB p_BC + R_WB v_BC),
/// averaged over the feet with their normal forces as weights. Between two
/// measurements, and in flight, the accelerometer is integrated:
///     v+ = v + dt (R_WB f + g),  then  v+ += dt / tau (v_legs - v+).
/// The heading is that of the inertial unit, with its drift.
///
/// A measurement is not used if a value of its inertial unit or its joints is
/// not finite or above 1e6, or if its time stamp is not finite. The state then
/// has the base and the time stamp of the last good measurement, and the joints
/// of this one, unchanged. The next good measurement bridges the gap. An
/// invalid joint value thus reaches the controller, which fails safe at once.
/// If the inertial unit stays invalid, the time stamp of the state stands
/// still, and the controller fails safe after the time that StateGuard allows.
/// A foot whose force is not finite counts as unloaded.
class Estimator {
 public:
  /// @param velocity_time  tau, s. A small value trusts the legs more, a large
  ///                       value the accelerometer.
  explicit Estimator(const Robot& robot, double velocity_time = 0.01);

  /// Starts from a known pose of the base: uses X_WB and V_WB_W of the
  /// measurement. Update() does not use them. pre: all values are finite.
  void Start(const Measurement& measurement);

  /// Writes the state from a measurement. Does not read X_WB and V_WB_W.
  /// pre: state has the sizes of the tree. Does not allocate.
  void Update(const Measurement& measurement, State* state) noexcept;

 private:
  // Computes p_BC_W and v_BC_W of each foot, with the base at X_WB = (R_WB, 0)
  // and its twist (w, 0).
  void ComputeFeet(const Measurement& measurement, State* state) noexcept;

  Robot robot_;
  double velocity_time_;
  Tick tick_;
  struct FootState {
    bool in_contact = true;
    Eigen::Vector3d p_WC;    // Touchdown position.
    Eigen::Vector3d p_BC_W;  // Position from the base, by the leg.
    Eigen::Vector3d v_BC_W;  // Velocity from the leg and the base's rotation.
  };
  std::vector<FootState> feet_;
  Eigen::Vector3d p_WB_;
  Eigen::Vector3d v_WB_;
  // Base state from the last measurement that was used.
  Eigen::Matrix<double, 7, 1> q_base_;
  Eigen::Matrix<double, 6, 1> v_base_;
  double time_ = 0;
};

}  // namespace poise
