// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/gait/push_estimate.h"
#include "poise/robot/gait/step_region.h"
#include "poise/robot/gait/step_trigger.h"
#include "poise/robot/gait/swing_path.h"

namespace poise {

/// Settings of a Gait. Lengths, times and speeds hold for a robot whose center
/// of mass is kTunedHeight above its soles: see Scaled().
struct GaitSettings {
  /// Height of the center of mass for which the defaults were tuned, m: that of
  /// robot/models/humanoid.urdf in its nominal posture.
  static constexpr double kTunedHeight = kTunedComHeight;

  double dt = 1e-3;  ///< Control period, s.
  /// Share of the angular momentum in the DCM, 0 to 1: see ComputeDcm().
  double share_of_k = 0.985;
  StepTrigger trigger;  ///< For a robot that turns its trunk strongly.
  /// For a robot that cannot turn it, see FitToStrength().
  StepTrigger weak_trigger{0.75, 0.8, 1.05};
  PushEstimate::Settings push;
  StepRegion::Settings region;
  SwingPath::Settings path;
  int max_steps = 12;  ///< Steps in a row; then the robot stays where it is.

  // Steps that catch the robot.
  double time_min = 0.193;       ///< Shortest time of a step, s.
  double time_max = 0.244;       ///< Longest time of a step, s.
  double swing_speed = 4.4;      ///< Bound of the mean speed of a step, m/s.
  double freeze = 0.025;         ///< The plan is kept for this last time, s.
  double sole_fraction = 0.907;  ///< Part of the sole that plans use.
  double sole_gap = 0.02;        ///< Between two soles side by side, m.
  /// Preferred way of xi beyond the sole's center at the landing, as a part of
  /// the nominal width, away from the stance foot.
  double xi_beyond = 0.09;
  double place_weight = 0.047;  ///< See StepPlan.
  double time_weight = 0.01;
  double sink_at = 0.75;   ///< The CoM has sunk at this share of the step.
  double min_sink = 0.04;  ///< Sink of each step, m.
  double square = 0.05;    ///< Feet are square within this distance, m.

  // Weights and bounds of MomentumTask during these steps.
  double angular_weight = 15;  ///< 1/m2.
  double height_weight = 1.2;
  double first_rise = 1.6;  ///< PendulumReference::max_rise in the first step.
  double later_rise = 7;    ///< PendulumReference::max_rise in later steps.

  // Steps on command.
  /// The foot is over its place early, and touches the ground at rest.
  SwingPath::Settings command_path{0.05, 0.7, 0.35, 0.55, 0.11};
  double shift_time = 1.0;    ///< CoM from the middle over a foot, s.
  double command_time = 0.8;  ///< Time of the step, s.
  double rest_time = 0.5;     ///< CoM back to the nominal height, s.
};

/// Returns the settings for a robot whose center of mass is `com_height` above
/// its soles, m, by Froude's rule: lengths scale with the height, times and
/// speeds with its square root, angular_weight with its square's inverse, and
/// accelerations and angles not at all. The control period, and how long pushes
/// last, do not depend on the robot.
GaitSettings Scaled(const GaitSettings& settings, double com_height);

}  // namespace poise
