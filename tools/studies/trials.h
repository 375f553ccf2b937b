// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

#include "poise/sim/experiment.h"
#include "poise/sim/judge.h"

namespace poise {

/// A run under adverse conditions, and the result that it must have.
struct Trial {
  enum class Bar {
    kRecovers,
    kFalls,    ///< Does not recover, like the paper's robot.
    kSteady,   ///< Recovers with a final CoM error below 3 mm in each axis.
    kFlat,     ///< Recovers, and its feet tilt by less than 0.02 rad.
    kUpright,  ///< Recovers; its pelvis leans below 0.02 rad, not increasing.
  };

  std::string what;
  Experiment experiment;
  /// The options of `push` that run the same experiment, for the table. Files
  /// are printed without folder, numbers with six digits.
  std::string options;
  Bar bar = Bar::kRecovers;
};

/// The result of a trial.
struct TrialResult {
  Verdict verdict;
  double lean_peak = 0;   ///< Largest tilt of the pelvis, rad.
  double lean_late = 0;   ///< Largest tilt in the last quarter, rad.
  double lean_early = 0;  ///< Largest tilt in the second quarter, rad.
  double joint_violation =
      0;  ///< Largest violation of a joint limit, rad or m.
  int self_contact_ticks = 0;
  bool holds = false;  ///< The trial has the result that it must have.
};

/// Returns trials with pushes in all directions, and with errors that a
/// controller meets outside of a simulator: wrong masses, delays, noise,
/// slippery ground, weak motors, low control rates. Each trial is a row of
/// docs/notebook.
std::vector<Trial> RobustnessTrials();

/// Returns trials of a robot that may step: pushes from 16 directions with 80 %
/// of the impulse that docs/steps.md aims at, and with each of these errors: a
/// mass 10 % wrong, delays, noise with an estimated base, slippery ground, low
/// rates, MuJoCo, gains 20 % wrong.
std::vector<Trial> StepTrials();

/// Runs a trial. Throws as ClosedLoop does.
TrialResult Try(const Trial& trial);

/// Returns the row of the trial in a table in Markdown.
std::string ToRow(const Trial& trial, const TrialResult& result);

}  // namespace poise
