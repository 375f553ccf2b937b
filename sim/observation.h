// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// True state of one foot.
struct FootObservation {
  Pose X_WC;         ///< Contact frame.
  bool down = true;  ///< Planned to be in contact.
  /// The ground presses on the sole during the tick that begins here.
  bool in_contact = true;
  double tilt = 0;   ///< Tilt of the sole since it was put down, rad.
  double slide = 0;  ///< Slide along the ground since it was put down, m.
  Eigen::Matrix<double, 6, 1> F_Co_C =
      Eigen::Matrix<double, 6, 1>::Zero();  ///< Mean over the tick.
};

/// True state of the robot at the start of a tick, and mean forces during the
/// tick. The log records it, and the judge decides by it.
struct Observation {
  double time = 0;
  Pose X_WB;
  double com_height = 0;  ///< Height of the CoM above the ground's plane, m.
  double base_tilt = 0;   ///< Angle of the base's z from the start, rad.
  Eigen::Vector3d com = Eigen::Vector3d::Zero();
  Eigen::Vector3d com_velocity = Eigen::Vector3d::Zero();  ///< m/s.
  Eigen::Vector3d com_ref = Eigen::Vector3d::Zero();
  /// DCM with the angular momentum given back, see ComputeDcm(), m.
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  std::vector<FootObservation> feet;
  /// Center of pressure of all feet together, m, in the frame MidFeet() of the
  /// feet that the ground presses on, as in the controller's task zmp. NaN if
  /// no foot has load.
  Eigen::Vector2d cop = Eigen::Vector2d::Zero();
};

/// Computes observations from the plant's true state, with the true model.
class Observer {
 public:
  Observer(const Robot& robot, const Ground& ground);

  /// Observes the state at the start of a tick. `down` marks the feet that are
  /// meant to be in contact; empty means all. Tilt and slide of a foot count
  /// from the tick in which it is put down.
  void ObserveState(const PlantState& state, const std::vector<bool>& down,
                    const Eigen::Vector3d& com_ref);

  /// Moves com_ref in the plane, so that it has the same place amid the true
  /// feet as it has amid the feet where the controller believes them. An
  /// estimate of the base drifts when feet slip, and a robot that stands amid
  /// its feet has no error by that.
  void MoveComReference(const std::vector<ContactTick>& believed);

  /// Observes the mean contact wrenches during the tick, by foot.
  void ObserveForces(const std::vector<Eigen::Matrix<double, 6, 1>>& F_Co_C);

  const Observation& observation() const { return observation_; }

  /// Returns the orientation of a body at the start of the tick.
  const Eigen::Matrix3d& R_WB(int body) const {
    return tick_.X_WB[static_cast<size_t>(body)].R;
  }

 private:
  Robot robot_;
  Eigen::Vector3d normal_W_;
  double mass_, gravity_;
  Tick tick_;
  Observation observation_;
  std::vector<ContactTick> contacts_;  // Only pose and measured contact.
  std::vector<Pose> put_down_;         // Each foot's pose when it was put down.
  std::vector<bool> was_down_;
  Eigen::Vector3d standing_z_B_ = Eigen::Vector3d::UnitZ();
  bool first_ = true;
};

/// Returns the height of the center of mass above the lowest sole in the
/// nominal posture, m. The origin of the root link is no measure of a robot's
/// height: in some files it lies on the ground.
double StandingHeight(const Robot& robot);

}  // namespace poise
