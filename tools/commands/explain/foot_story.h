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

  FootStory(const std::string& foot, const LogReader& log);

  /// Adds the current row of the log.
  void Look(double time, const LogReader& log);

  const std::string& foot() const { return foot_; }
  const std::vector<Phase>& phases() const { return phases_; }

  /// The times at which the foot first rolled over an edge, or slid, while it
  /// should have been in contact, s.
  std::optional<double> rolls() const { return rolls_; }
  std::optional<double> slides() const { return slides_; }

  /// Returns sentences about the phases, rolls() and slides(). Each has its
  /// time, s. The sentences are not sorted.
  std::vector<std::pair<double, std::string>> Sentences() const;

 private:
  std::string foot_;
  std::optional<int> contact_, tilt_, slide_, phase_;
  std::optional<double> rolls_, slides_;  // See rolls(), s.
  std::vector<Phase> phases_;
};

}  // namespace poise
