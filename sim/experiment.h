// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"
#include "poise/sim/scenario.h"

namespace poise {

/// A robot and the scenario that it runs. The two determine a run to the bit.
struct Experiment {
  Robot robot;
  Scenario scenario;
};

/// Sets the task set of a scenario to the profile's own tasks, if the profile
/// has tasks and the scenario has the default task set.
void UseTasksOf(const Profile& profile, Scenario* scenario);

/// Loads a robot that stands, for a scenario. The tasks are those of
/// UseTasksOf().
///
/// @param findings  if not null, receives the findings of LoadUrdf() and
///                  FindFeet().
///
/// Throws as LoadStandingRobot().
Experiment LoadExperiment(const std::filesystem::path& urdf,
                          const Profile& profile, Scenario scenario,
                          std::vector<Finding>* findings = nullptr);

}  // namespace poise
