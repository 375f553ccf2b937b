// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poise/sim/log/log_reader.h"

namespace poise {

/// Collects the phases of a foot in a run, and the times at which the foot
/// first rolled or slid while it should have been in contact. If the log does
/// not have the columns, there are no phases and no times.
class FootStory {
 public:
  struct Phase {
    std::string name;  ///< As in the log: "down", "free", ...
    double from, to;   ///< Times of its first and its last row, s.
  };

  /// A step. Values that the log does not have are NaN.
  struct Step {
    double at, landing;  ///< Times of the lift-off and of the landing, s.
    double x, y;         ///< Planned place, m.
    double beyond;       ///< See Gait::beyond_edge(), m.
    bool has_landed;     ///< Before the end of the log.
  };

  FootStory(const std::string& foot, const LogReader& log);

  /// Adds the current row of the log.
  void Look(double time, const LogReader& log);

  const std::string& foot() const { return foot_; }
  const std::vector<Phase>& phases() const { return phases_; }
  const std::vector<Step>& steps() const { return steps_; }

  /// The times at which the foot first rolled over an edge, or slid, while it
  /// should have been in contact, s.
  std::optional<double> rolls() const { return rolls_; }
  std::optional<double> slides() const { return slides_; }

  /// Returns sentences about the phases, but not the steps, and about rolls()
  /// and slides(). Each has its time, s. The sentences are not sorted.
  std::vector<std::pair<double, std::string>> Sentences() const;

 private:
  void LookAtStep(double time, const LogReader& log);

  std::string foot_;
  std::optional<int> contact_, tilt_, slide_, phase_;
  std::optional<double> rolls_, slides_;  // See rolls(), s.
  std::vector<Phase> phases_;
  std::optional<int> plan_x_, plan_y_, beyond_;
  std::vector<Step> steps_;
};

/// Returns a sentence about a step: "1.022 s: the robot steps with the left
/// foot, planned to (0.17, 0.45) m, in 0.17 s, as the capture point is 4 cm
/// beyond the edge."
std::string SayStep(const std::string& foot, const FootStory::Step& step);

}  // namespace poise
