// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/robot.h"

namespace poise {

/// Estimates the state of the base from orientation, gyroscope and accelerometer of
/// the inertial unit, and from the joints of the legs in contact.
///
/// A foot in contact does not move from p_WC, the place of its touchdown. With the
/// orientation R_WB of the inertial unit,
///     p_WB = p_WC - R_WB p_BC(q),       v_WB = -(w x R_WB p_BC + R_WB v_BC),
/// weighted over the feet by their normal forces. The accelerometer predicts the
/// velocity, also during a flight,
///     v+ = v + dt (R_WB f + g),  then  v+ += dt / tau (v_legs - v+).
/// The heading is that of the inertial unit.
///
/// A measurement is not used if its stamp, inertial unit or joints are not finite or
/// beyond 1e6. The state then keeps base and stamp of the last used measurement and
/// has the joints of this one; the next valid measurement bridges the gap. So an
/// invalid joint reaches the controller, which fails safe at once. If all
/// measurements of the base are invalid, the stamp stands still, and the controller
/// fails safe after 10 ms. A foot whose force is not finite counts as unloaded.
class Estimator {
 public:
  /// @param velocity_time  tau, s. A smaller value weights the legs more, a larger
  ///                       value the accelerometer.
  explicit Estimator(const Robot& robot, double velocity_time = 0.01);

  /// Starts from the base pose X_WB and twist V_WB_W of the measurement; later calls
  /// do not read them. pre: all values are finite.
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
    Eigen::Vector3d p_WC;    // Place of its touchdown.
    Eigen::Vector3d p_BC_W;  // From the joint positions.
    Eigen::Vector3d v_BC_W;  // From joint rates and base rotation.
  };
  std::vector<FootState> feet_;
  Eigen::Vector3d p_WB_;
  Eigen::Vector3d v_WB_;
  Eigen::Matrix<double, 7, 1> q_base_;  // From the last accepted measurement.
  Eigen::Matrix<double, 6, 1> v_base_;
  double time_ = 0;
};

}  // namespace poise
