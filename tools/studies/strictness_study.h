// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/sim/experiment.h"
#include "poise/sim/judge.h"

namespace poise {

/// A way to prioritise the same tasks: by levels, by weights, or by both.
struct Weighing {
  std::string name;
  std::function<void(Stack*)> arrange;
};

/// Returns the ways that are compared: strict levels; constraints strictly
/// before all tasks, which are weighted; all in one weighted QP.
std::vector<Weighing> Weighings();

/// Result of one way in the ticks in which a contact constraint is active. All
/// ways solve the same problems, which the strict hierarchy meets in its run.
struct WeighingResult {
  long ticks = 0;  ///< Ticks with an active contact constraint.
  /// Root mean square of the residuals: of the momentum, N, and of the posture,
  /// rad/s2.
  double momentum = 0, posture = 0;
  /// Largest violation in all ticks: of the contacts, m/s2 and rad/s2, and of
  /// the force inequalities, as a fraction of a quarter of the weight.
  double contact = 0, force = 0;
  double median_us = 0, p99_us = 0;  ///< Time of a tick, over all.
  int failures = 0;  ///< Ticks that were not solved to the last level.
};

/// Compares all ways on the states of one run of the experiment.
std::vector<WeighingResult> CompareWeighings(const Experiment& experiment);

/// Runs the experiment to its end with one way and returns its verdict.
Verdict RunWeighing(const Experiment& experiment, const Weighing& weighing);

}  // namespace poise
