// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "poise/robot/control/stance.h"
#include "poise/robot/robot.h"
#include "poise/sim/observation.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Watches whether the motions that a scenario commands happen: shifts of the
/// CoM, lifts of a foot, putting it down, and the motion of the CoM. A robot
/// that its own joint friction holds may recover without moving.
///
/// - A shift happened if the CoM came nearer to its place than a quarter of the
///   way, after the shift and before the next command.
/// - A lift happened if the sole rose by half of the height, before the foot is
///   put down.
/// - A foot was put down if the ground pressed on it while it was meant down.
/// - The motion of the CoM happened if its component of the commanded
///   frequency, along the commanded directions, has half of the commanded
///   amplitude. It may lag behind by less than a quarter of the period.
///
/// A command whose time ends before its motion can be complete is not judged.
class CommandWatch {
 public:
  static constexpr double kShiftShare = 0.25;
  static constexpr double kLiftShare = 0.5;
  static constexpr double kMotionShare = 0.5;

  /// `stance` has the times in which a foot is lifted or put down.
  /// @pre The scenario is valid.
  CommandWatch(const Robot& robot, const Scenario& scenario,
               const StanceSettings& stance);

  void Look(const Observation& now);

  /// Returns whether a command is judged in a run that ends at `end`, s.
  bool has_command(double end) const;

  /// Returns the commands that are judged and did not happen, in words.
  std::vector<std::string> Missed(double end) const;

 private:
  // Sums of a motion times the cosine and the sine of the commanded frequency.
  struct Component {
    Eigen::Vector3d cosine = Eigen::Vector3d::Zero();
    Eigen::Vector3d sine = Eigen::Vector3d::Zero();
  };

  struct Command {
    StanceEvent event;
    int foot;      // Index, or -1.
    double ready;  // Time from which the motion can be complete, s.
    double until;  // Start of the next command that ends this one, s.
    Eigen::Vector3d begin = Eigen::Vector3d::Zero();  // com_ref at its start.
    double ground = 0;  // Height of the sole at its start, m.
    double way = 0;     // Length of a shift, m.
    double best = 0;    // Least distance to the place; rise of the sole, m.
    bool has_begun = false;
    bool is_done = false;
  };

  void LookAt(const Observation& now, Command* command) const;
  double MotionShare() const;
  static bool IsJudged(const Command& command, double end);
  bool IsMotionJudged(double end) const;

  double dt_;
  ComMotion com_;
  std::vector<Command> commands_;
  Eigen::Vector3d com_start_ = Eigen::Vector3d::Zero();
  Component commanded_, moved_;
  bool has_begun_ = false;
};

}  // namespace poise
