// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poise/sim/log/log_reader.h"

namespace poise {

/// What became of a foot in a run: its phases, and when, meant to be down, it
/// first rolled or slid. A log that does not have the columns has no story.
class FootStory {
 public:
  struct Phase {
    std::string name;  ///< As in the log: "down", "free", ...
    double from, to;   ///< The first and the last row of it, s.
  };

  FootStory(const std::string& foot, const LogReader& log);

  /// Takes in a row of the log.
  void Look(double time, const LogReader& log);

  const std::string& foot() const { return foot_; }
  const std::vector<Phase>& phases() const { return phases_; }

  /// When the foot, meant to be down, first rolled over an edge or slid, s.
  std::optional<double> rolls() const { return rolls_; }
  std::optional<double> slides() const { return slides_; }

  /// The same for a person, each with its time, s; not in order.
  std::vector<std::pair<double, std::string>> Sentences() const;

 private:
  std::string foot_;
  std::optional<int> contact_, tilt_, slide_, phase_;
  std::optional<double> rolls_, slides_;  // Since when, s.
  std::vector<Phase> phases_;
};

}  // namespace poise
