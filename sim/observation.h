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
  /// The ground presses on its sole in the tick that follows, as measured.
  bool in_contact = true;
  double tilt = 0;   ///< Tilt of the sole since it was put down, rad.
  double slide = 0;  ///< Along the ground since it was put down, m.
  Eigen::Matrix<double, 6, 1> F_Co_C =
      Eigen::Matrix<double, 6, 1>::Zero();  ///< Over the tick that follows.
};

/// True state of the robot at the start of a tick, and mean forces during the
/// tick. The log records it, and the judge decides by it.
struct Observation {
  double time = 0;
  Pose X_WB;
  double base_height = 0;  ///< Height of BasePoint() above the ground, m.
  double base_tilt = 0;    ///< Angle of the base's z from the start, rad.
  Eigen::Vector3d com = Eigen::Vector3d::Zero();
  Eigen::Vector3d com_ref = Eigen::Vector3d::Zero();
  std::vector<FootObservation> feet;
  /// Center of pressure of all feet together in MidFeet() of the feet that the
  /// ground presses on, as the controller's task zmp has it; NaN where they bear
  /// nothing.
  Eigen::Vector2d cop = Eigen::Vector2d::Zero();
};

/// Computes observations from the plant's truth, with the true model.
class Observer {
 public:
  Observer(const Robot& robot, const Ground& ground);

  /// Takes the start of a tick; `down` says which feet are meant to be in
  /// contact, nothing being all. A foot counts from where it is put down.
  void ObserveState(const PlantState& state, const std::vector<bool>& down,
                    const Eigen::Vector3d& com_ref);

  /// Takes what acted during the tick.
  void ObserveForces(const std::vector<Eigen::Matrix<double, 6, 1>>& F_Co_C);

  const Observation& observation() const { return observation_; }

  /// The orientation of a body at the start of the tick.
  const Eigen::Matrix3d& R_WB(int body) const { return tick_.X_WB[body].R; }

 private:
  Robot robot_;
  Eigen::Vector3d base_point_B_;
  Eigen::Vector3d normal_W_;
  Tick tick_;
  Observation observation_;
  std::vector<ContactTick> contacts_;  // Pose and measured contact alone.
  std::vector<Pose> put_down_;         // Each foot's pose when it was put down.
  std::vector<bool> was_down_;
  Eigen::Vector3d standing_z_B_ = Eigen::Vector3d::UnitZ();
  bool first_ = true;
};

/// The point of the base, in its axes, by whose height it is seen to lie: the
/// origin of the root link or, where that is a mere frame that may be anywhere,
/// as `world` on the floor, of the first link with a shape that is fixed to it.
Eigen::Vector3d BasePoint(const RobotModel& model);

/// The height of BasePoint() in the nominal posture, which stands on the ground.
double StandingHeight(const Robot& robot);

}  // namespace poise
