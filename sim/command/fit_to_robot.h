// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include "poise/robot/robot.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Fits a scenario to a robot. The robot of Scenario::chosen_for, recognised by
/// a mass and a StandingHeight() within 1 %, gets the scenario unchanged. On
/// any other robot
/// - Push::elsewhere becomes Push::impulse_fraction, and
/// - these lengths are multiplied by the ratio of the StandingHeight()s: the
///   motion of the CoM, heights of lifted feet, the drop at the start, boards.
///
/// The result has neither `chosen_for` nor `elsewhere`. Without `chosen_for`,
/// lengths are unchanged. @pre The scenario is valid.
Scenario FitToRobot(const Robot& robot, Scenario scenario);

}  // namespace poise
