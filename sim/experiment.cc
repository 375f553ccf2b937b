// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/experiment.h"

#include <utility>

#include "poise/robot/control/stand.h"

namespace poise {

void UseTasksOf(const Profile& profile, Scenario* scenario) {
  if (profile.tasks.IsDefined() && scenario->control.tasks == "default") {
    scenario->control.tasks = profile.file.string();
  }
}

Experiment LoadExperiment(const std::filesystem::path& urdf,
                          const Profile& profile, Scenario scenario,
                          std::vector<Finding>* findings) {
  UseTasksOf(profile, &scenario);
  return {LoadStandingRobot(urdf, profile, findings), std::move(scenario)};
}

}  // namespace poise
