// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "poise/sim/experiment.h"
#include "poise/sim/judge.h"

namespace poise {

/// A run under adverse conditions, and what it must do all the same.
struct Trial {
  enum class Bar {
    kRecovers,
    kFalls,    ///< As the paper's robot does.
    kSteady,   ///< Recovers, to 3 mm in each axis.
    kFlat,     ///< Recovers, its feet within 0.02 rad.
    kUpright,  ///< Recovers, its pelvis within 0.02 rad, and not ever farther.
  };

  std::string what;
  Experiment experiment;
  /// The options with which `push` runs the same experiment, for the table: files
  /// without their folder, numbers with six digits.
  std::string options;
  Bar bar = Bar::kRecovers;
};

/// What a trial came to.
struct TrialResult {
  Verdict verdict;
  double lean_peak = 0;        ///< Of the pelvis from how it stood, rad.
  double lean_late = 0;        ///< Its peak in the last quarter, rad,
  double lean_early = 0;       ///< and in the second one.
  double joint_violation = 0;  ///< Of joint limits, the largest, rad or m.
  int self_contact_ticks = 0;
  bool holds = false;  ///< It did what the bar says.
};

/// Pushes in all directions, and what a controller meets outside of a simulator:
/// wrong masses, delays, noise, slippery ground, weak motors, slow clocks; each row
/// of docs/control.md.
std::vector<Trial> RobustnessTrials();

/// Robots that others have built: each stands off its equilibrium, and is pushed
/// sideways by 40 % of what a pendulum on its feet takes. A robot has the profile
/// of FindProfile(), or feet and a posture that are found. The warnings about each
/// robot are printed on stderr.
///
/// @param robots  the folder of their URDF files.
/// @param only    rows whose name contains this.
/// @param skipped  "FILE is skipped: why", of those that cannot be simulated or
///                 have no feet.
/// Throws std::invalid_argument about a folder without URDF files.
std::vector<Trial> RobotTrials(const std::filesystem::path& robots,
                               const std::string& only,
                               std::vector<std::string>* skipped);

/// Throws as ClosedLoop.
TrialResult Try(const Trial& trial);

/// A row of a table in Markdown.
std::string ToRow(const Trial& trial, const TrialResult& result);

}  // namespace poise
