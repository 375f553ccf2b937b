// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "poise/math/pose.h"
#include "poise/tools/drawing/robot_picture.h"

namespace poise {

/// Returns an arrow for each push of a run whose mean force over the tick from
/// `time` is not zero, at its own link and point.
///
/// @param summary  summary.json of the run, see sim/log/summary.h.
/// @param time     start of a tick, s.
/// @param X_WB     poses of the robot's bodies at `time`.
std::vector<PushArrow> FindPushArrows(const nlohmann::json& summary,
                                      double time,
                                      const std::vector<Pose>& X_WB);

}  // namespace poise
