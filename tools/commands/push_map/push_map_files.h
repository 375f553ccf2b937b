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

/// A point of the map: from where, how long, and under which tasks.
struct PushMapPoint {
  double direction_deg;
  double duration;  ///< Of the push, s.
  std::string tasks;

  friend bool operator<(const PushMapPoint& a, const PushMapPoint& b) {
    return std::tie(a.tasks, a.duration, a.direction_deg) <
           std::tie(b.tasks, b.duration, b.direction_deg);
  }
};

/// What was found there, N s.
struct PushMapValue {
  double impulse;
  double lipm;
  double lipm_height;
};

/// The files of a push map in a folder: map.csv, what was found, and
/// trials.csv, every run that led there. Written line by line as results come,
/// so that a map that was interrupted goes on with the next run. A last line
/// cut short is written over. All members may be called from any thread.
class PushMapFiles {
 public:
  /// @param settings  what a result depends on beside its point. A folder with
  ///                  a map of other settings is refused.
  /// @param header    map.csv begins with the names of its columns.
  /// Throws std::invalid_argument if the folder cannot be used.
  PushMapFiles(const std::filesystem::path& folder, const std::string& settings,
               bool header);

  std::optional<PushMapValue> Found(const PushMapPoint& point) const;
  std::optional<bool> Tried(const PushMapPoint& point, double impulse) const;

  void AddFound(const PushMapPoint& point, const PushMapValue& value);
  void AddTried(const PushMapPoint& point, double impulse, bool recovered);

  std::map<PushMapPoint, PushMapValue> found() const;

 private:
  void WriteMap() const;
  void WriteTrials() const;

  std::filesystem::path folder_;
  bool header_;
  mutable std::mutex mutex_;
  std::map<PushMapPoint, PushMapValue> found_;
  std::map<PushMapPoint, std::map<double, bool>> tried_;
};

/// The name of a task set: "default", or its changes: "-cop-yaw+yaw_constant".
std::string TaskSetName(const std::vector<std::string>& with,
                        const std::vector<std::string>& without);

}  // namespace poise
