// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "poise/robot/control/command.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/estimator.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/gait/gait.h"
#include "poise/robot/robot.h"
#include "poise/sim/command/center_of_mass_path.h"
#include "poise/sim/command/lean_path.h"
#include "poise/sim/log/tick_record.h"
#include "poise/sim/observation.h"
#include "poise/sim/plants/plant.h"
#include "poise/sim/push.h"
#include "poise/sim/scenario.h"
#include "poise/sim/sensors.h"

namespace poise {

/// A step that a scenario commands.
struct CommandedStep {
  double at;           ///< Time of the command, s.
  int foot;            ///< Index of the foot.
  Eigen::Vector2d to;  ///< Place of the sole's center, m.
  StepAnswer answer;   ///< Answer of the gait.
};

/// Simulates a robot, its plant and its controller, tick by tick:
///
///     plant -> sensors -> controller -> (delay) -> plant, with pushes.
///
/// Two loops of the same robot and scenario agree to the bit, even if other
/// loops run in parallel: all random numbers come from the scenario's seed.
class ClosedLoop {
 public:
  /// Throws InputError as Validate(), and if the scenario names something that
  /// the robot does not have, such as a task or a link. The error's field is
  /// "robot" if the plant or the controller cannot use the robot. Throws
  /// Refusal about a file.
  /// @param add_tasks  see ControllerOptions::add_tasks.
  ClosedLoop(const Robot& robot, const Scenario& scenario,
             const std::function<void(Stack*)>& add_tasks = {});

  /// Runs one control tick.
  void Tick();

  /// Adds a push, before the first tick or between two ticks. The part of the
  /// push before time() does not act. Throws InputError as the constructor.
  void AddPush(const Push& push);

  double time() const { return plant_->Sense().time; }
  const Robot& robot() const { return robot_; }
  /// Returns the scenario, fitted to the robot, see FitToRobot().
  const Scenario& scenario() const { return scenario_; }

  /// Returns the record of the last tick. Valid until the next one.
  TickRecord record() const;
  const Observation& observation() const { return observer_.observation(); }
  Controller& controller() { return *controller_; }
  const Controller& controller() const { return *controller_; }
  /// Null without Scenario::steps.
  const Gait* gait() const { return gait_.get(); }
  /// The steps that the scenario has commanded up to now.
  const std::vector<CommandedStep>& commanded() const { return commanded_; }
  /// In words: the pushes up to now that are a fraction of a bound of 0, and
  /// the shifts, lifts, put_downs and motions of the center of mass that were
  /// not executed, because from the first step on the gait alone moves the feet
  /// and the center of mass.
  const std::vector<std::string>& impossible() const { return impossible_; }
  const Plant& plant() const { return *plant_; }

 private:
  int FindFoot(const std::string& name) const;
  void Shift(const StanceEvent& event);
  void MoveFeet();
  void MoveFoot(const StanceEvent& event);
  void SizePushes();
  void StepPlant();

  Robot robot_;
  Scenario scenario_;
  std::unique_ptr<Plant> plant_;
  std::unique_ptr<Controller> controller_;
  Sensors sensors_;
  std::unique_ptr<Estimator> estimator_;  // Null without control.estimator.
  std::unique_ptr<Gait> gait_;            // Null without steps.
  Observer observer_;
  std::vector<PushOnRobot> pushes_;
  std::vector<Eigen::Vector3d> directions_;  // Forces before SizePushes().
  std::vector<bool> is_sized_;               // By push.
  std::vector<std::string> impossible_;
  std::vector<bool> down_;  // By foot: planned to be in contact.
  int steps_per_tick_;
  int delay_steps_;

  State state_;                          // State that the controller receives.
  PlantState start_;                     // State at the start of the tick.
  Command command_;                      // Newest command.
  std::deque<Eigen::VectorXd> torques_;  // Delayed torques, one per plant step.
  Eigen::Vector3d com_start_;
  CenterOfMassPath com_path_;
  LeanPath lean_path_;
  size_t next_event_ = 0;  // Index in the scenario's stance.
  std::vector<CommandedStep> commanded_;
  PlantState during_;  // State at the end of the tick; mean forces over it.
  Eigen::Vector3d push_force_W_ = Eigen::Vector3d::Zero();
  long ticks_ = 0;
  double microseconds_ = 0;
};

}  // namespace poise
