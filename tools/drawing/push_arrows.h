// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "poise/math/pose.h"
#include "poise/tools/drawing/robot_picture.h"

namespace poise {

/// Returns an arrow for each push of a run whose mean force during a control
/// tick is not zero. Each arrow is at the link and point of its push.
///
/// @param summary  the contents of the run's summary.json, see
///                 sim/log/summary.h.
/// @param time     the start of the tick, s.
/// @param X_WB     the poses of the robot's bodies at `time`.
std::vector<PushArrow> FindPushArrows(const nlohmann::json& summary,
                                      double time,
                                      const std::vector<Pose>& X_WB);

}  // namespace poise
