// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "poise/sim/experiment.h"
#include "poise/tools/commands/push_map/push_map_files.h"

namespace poise {

/// What a map is made of: an experiment whose first push is turned and scaled.
struct PushMapPlan {
  Experiment experiment;
  std::vector<PushMapPoint> points;  ///< Of this run or shard.
  std::filesystem::path folder;
  int threads = 1;
  double step = 0.25;   ///< Of impulses, N s.
  bool replays = true;  ///< A page for each point, in replays/.
};

/// How far a map is.
struct PushMapProgress {
  int points_done;
  int points;
  int trials;           ///< Of this run.
  double seconds_left;  ///< As far as can be told; negative if it cannot.
};

/// The experiment of a point of the map: its first push with this impulse, N s.
Experiment PushExperiment(const PushMapPlan& plan, const PushMapPoint& point,
                          double impulse);

/// Where the replay of a point is, in the plan's folder.
std::filesystem::path ReplayFile(const PushMapPoint& point);

/// Finds the largest recovered impulse of each point, with so many threads. What
/// the files hold already is not done again.
///
/// @param progress  called after every trial, never by two threads at once;
///                  stops all by returning false.
///
/// Returns whether all points were found. Rethrows what a trial threw.
bool RunPushMap(const PushMapPlan& plan, PushMapFiles* files,
                const std::function<bool(const PushMapProgress&)>& progress);

/// The map as JSON: {format, robot, scenario, step, rows: [{direction_deg,
/// duration_s, tasks, impulse_Ns, lipm_Ns, lipm_height_Ns, eta, replay}]}, the
/// replay being the path of a page in the folder, where there is one.
nlohmann::json MapToJson(const PushMapPlan& plan, const PushMapFiles& files);

/// Writes the folder's map.html, from all that its map holds.
void WriteMapPage(const PushMapPlan& plan, const PushMapFiles& files);

}  // namespace poise
