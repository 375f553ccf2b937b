// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/load_humanoid.h"

#include "poise/robot/profile/profile.h"

namespace poise {

Robot LoadHumanoid() {
  return LoadRobot("robot/models/humanoid.urdf",
                   LoadProfile("robot/profiles/humanoid.yaml"));
}

}  // namespace poise
