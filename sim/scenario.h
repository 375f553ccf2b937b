// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "poise/sim/plants/plant_settings.h"
#include "poise/sim/push.h"
#include "poise/sim/sensor_settings.h"

namespace poise {

/// Offset of the start state from equilibrium.
struct StartSettings {
  double joints = 0;   ///< Joints outside the legs, each drawn in +- this, rad.
  double drop = 0;     ///< Height of the soles above the ground, m.
  double heading = 0;  ///< Heading of the robot in the world, rad.
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< Place of the feet, m.
};

/// The robot that the newtons and meters of a scenario are chosen for, see
/// FitToRobot().
struct ChosenFor {
  double mass = 40;         ///< kg.
  double com_height = 0.8;  ///< Height of the standing CoM above the soles, m.
};

/// Motion of the desired center of mass around its start:
///     sine sin(2 pi t / period) + cosine cos(2 pi t / period).
struct ComMotion {
  Eigen::Vector3d sine = Eigen::Vector3d::Zero();    ///< m.
  Eigen::Vector3d cosine = Eigen::Vector3d::Zero();  ///< m.
  double period = 10;                                ///< s.
};

/// An event of the stance. A foot is lifted or put down; or the desired center
/// of mass moves. It moves over a foot, a quarter of the sole's half width
/// inside of the foot's center, or back between the feet.
struct StanceEvent {
  enum class Kind { kLift, kPutDown, kShift, kStep };

  Kind kind = Kind::kShift;
  double at = 0;         ///< Time of the event, s.
  std::string foot;      ///< Name; empty: back to where the CoM started.
  double height = 0.05;  ///< Height that a foot is lifted by, m.
  double over = 1.5;     ///< Duration of a shift, s.
  /// Place of the sole's center after a step, in the world, m.
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

/// Settings of the controller, in addition to its robot.
struct ControlSettings {
  double dt = 1e-3;           ///< Control period, s.
  double delay = 0;           ///< From measurement to torque, s.
  double friction = 0.5;      ///< Coefficient mu that the controller assumes.
  double mass_error = 0;      ///< Relative error of all masses of its model.
  double ramp = 0;            ///< Changes of tasks take effect in this time, s.
  double budget_us = 0;       ///< Time for the solver in a tick; 0: no limit.
  bool budget_clock = false;  ///< By the clock: no replay is exact.
  bool inscribed = false;     ///< The friction pyramid is inside the cone.
  bool feedforward = false;   ///< Feeds forward v_WG, a_WG of the reference.
  bool weighted = false;      ///< One weighted QP instead of the hierarchy.
  bool estimator = false;  ///< Estimates the base instead of using the truth.
  bool drag_compensation = true;     ///< Torques against joint friction.
  std::string tasks = "default";     ///< A task set, by name or file.
  std::vector<std::string> with;     ///< Tasks switched on in it.
  std::vector<std::string> without;  ///< Tasks switched off in it.
};

/// One experiment, as data instead of code in main(). docs/scenarios.md
/// describes its YAML file: every key and its default value.
struct Scenario {
  std::string name;
  double duration = 5;
  unsigned seed = 1;
  bool steps = false;  ///< The robot takes steps if it has to, see Gait.
  std::optional<ChosenFor> chosen_for;
  StartSettings start;
  std::vector<Push> pushes;
  std::vector<StanceEvent> stance;
  ComMotion com;
  ControlSettings control;
  std::string plant_kind = "bullet";  ///< One of PlantNames().
  PlantSettings plant;
  SensorSettings sensors;
};

/// Reads a scenario, without Validate(), so that options can change it first.
/// Throws std::invalid_argument("FILE:LINE: ...") with the key, its value and
/// the allowed values. Rejects unknown keys.
Scenario ReadScenario(const std::filesystem::path& file);

/// Reads a scenario from the text of a file, as ReadScenario() does from a
/// file.
///
/// @param source  the name of the text in messages.
/// @param name    the scenario's name if the text has none.
Scenario ParseScenario(const std::string& text, const std::string& source,
                       const std::string& name);

/// Reads a scenario as ReadScenario(), and throws also as Validate().
Scenario LoadScenario(const std::filesystem::path& file);

/// Reads a list of pushes from a file whose one key is `pushes`.
std::vector<Push> LoadPushes(const std::filesystem::path& file);

/// Throws InputError about the first field that is out of range or contradicts
/// another field. The error has the field's path in the file: "control.rate".
void Validate(const Scenario& scenario);

}  // namespace poise
