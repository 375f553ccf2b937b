// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "poise/sim/experiment.h"
#include "poise/tools/commands/push_map/push_map_files.h"

namespace poise {

/// The plan of a map. Each point changes direction, duration and force of the
/// first push of the experiment.
struct PushMapPlan {
  Experiment experiment;
  std::vector<PushMapPoint> points;  ///< Points of this run or shard.
  std::filesystem::path folder;
  int threads = 1;
  double step = 0.25;   ///< Between successive impulses, N s.
  bool scan = false;    ///< Try every impulse, see ScanImpulses().
  bool replays = true;  ///< Write a page for each point, in replays/.
};

/// The progress of a map.
struct PushMapProgress {
  int points_done;
  int points;
  int trials;           ///< Simulated pushes of this run.
  double seconds_left;  ///< Estimate; negative if unknown.
};

/// Returns the experiment of a point of the map, with an impulse of the first
/// push, N s.
Experiment PushExperiment(const PushMapPlan& plan, const PushMapPoint& point,
                          double impulse);

/// Returns the path of a point's replay, relative to the plan's folder.
std::filesystem::path ReplayFile(const PushMapPoint& point);

/// Finds the largest impulse of each point that the robot recovers from, by
/// bisection or, if plan.scan, the largest of all successive ones from 2 N s
/// on. Works with plan.threads threads. Results that the files already have are
/// not computed again.
///
/// @param progress  called after every trial, never by two threads at the same
///                  time. If it returns false, all threads stop.
///
/// Returns true if all points were found. Rethrows the first exception of a
/// trial.
bool RunPushMap(const PushMapPlan& plan, PushMapFiles* files,
                const std::function<bool(const PushMapProgress&)>& progress);

/// Returns the map as JSON: {format, robot, scenario, step, rows:
/// [{direction_deg, duration_s, tasks, impulse_Ns, lipm_Ns, lipm_height_Ns,
/// eta, replay}]}, in a map with steps also steps, step_Ns, eta_step, holes,
/// first_step_Ns. replay is the path of a page in the folder; it is absent if
/// there is no page.
nlohmann::json MapToJson(const PushMapPlan& plan, const PushMapFiles& files);

/// Writes map.html of the folder, with all results in `files`.
void WriteMapPage(const PushMapPlan& plan, const PushMapFiles& files);

}  // namespace poise
