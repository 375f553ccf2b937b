// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace poise {

/// A point of the map: direction and duration of the push, and the task set.
struct PushMapPoint {
  double direction_deg;
  double duration;  ///< Duration of the push, s.
  std::string tasks;

  friend bool operator<(const PushMapPoint& a, const PushMapPoint& b) {
    return std::tie(a.tasks, a.duration, a.direction_deg) <
           std::tie(b.tasks, b.duration, b.direction_deg);
  }
};

/// The result at a point of the map. All values are impulses, N s.
struct PushMapValue {
  double impulse;      ///< Largest impulse that the robot recovers from.
  double lipm;         ///< See Yardstick::lipm_Ns.
  double lipm_height;  ///< See Yardstick::lipm_height_Ns.
  /// Only in a map with steps.
  struct Steps {
    int count = 0;              ///< Steps taken after the largest impulse.
    double step_Ns = 0;         ///< See ComputeStepYardstick().
    std::vector<double> holes;  ///< See ImpulseScan.
    double first = 0;  ///< Smallest impulse with a step; 0 if none had one.
  };
  std::optional<Steps> steps = {};
};

/// A simulated push.
struct PushMapTrial {
  bool recovered = false;
  int steps = 0;  ///< Number of steps that the robot took.
};

/// The files of a push map in a folder: map.csv has the results, trials.csv has
/// every run that led to them. The files are written line by line as results
/// come, so that an interrupted map can continue. An incomplete last line is
/// ignored and overwritten. All members may be called from any thread.
class PushMapFiles {
 public:
  /// @param settings  all settings that results depend on, except the point.
  /// @param header    if true, map.csv begins with the names of its columns.
  /// @param with_steps  map.csv has the columns of a map with steps.
  /// Throws std::invalid_argument if the folder cannot be used, or if it has a
  /// map with other settings.
  PushMapFiles(const std::filesystem::path& folder, const std::string& settings,
               bool header, bool with_steps = false);

  std::optional<PushMapValue> Found(const PushMapPoint& point) const;
  std::optional<PushMapTrial> Tried(const PushMapPoint& point,
                                    double impulse) const;

  void AddFound(const PushMapPoint& point, const PushMapValue& value);
  void AddTried(const PushMapPoint& point, double impulse,
                const PushMapTrial& trial);

  std::map<PushMapPoint, PushMapValue> found() const;

 private:
  void WriteMap() const;
  void WriteTrials() const;

  std::filesystem::path folder_;
  bool header_, with_steps_;
  mutable std::mutex mutex_;
  std::map<PushMapPoint, PushMapValue> found_;
  std::map<PushMapPoint, std::map<double, PushMapTrial>> tried_;
};

/// Returns the name of a task set: "default", or its changes, such as
/// "-cop-yaw+yaw_constant".
std::string TaskSetName(const std::vector<std::string>& with,
                        const std::vector<std::string>& without);

}  // namespace poise
