// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/sim/experiment.h"
#include "poise/sim/judge.h"

namespace poise {

/// A way to weigh the same tasks against each other.
struct Weighing {
  std::string name;
  std::function<void(Stack*)> arrange;
};

/// Strictly by level; the constraints strictly before all tasks, which are
/// weighted; all as one weighted QP.
std::vector<Weighing> Weighings();

/// What a way to weigh makes of the ticks in which a constraint of the contacts
/// is active, on the very problems that the strict hierarchy meets on its way.
struct WeighingResult {
  long ticks = 0;  ///< With an active constraint.
  /// Residuals, root of the mean square: of the momentum, N, and of the
  /// posture, rad/s2.
  double momentum = 0, posture = 0;
  /// The largest violation in all ticks: of the contacts, m/s2 and rad/s2, and
  /// of the inequalities of forces, as a fraction of a quarter of the weight.
  double contact = 0, force = 0;
  double median_us = 0, p99_us = 0;  ///< Of all ticks.
  int failures = 0;  ///< Ticks that were not solved to the last level.
};

/// All ways, on the states of one run of the experiment.
std::vector<WeighingResult> CompareWeighings(const Experiment& experiment);

/// The experiment controlled in one way, to its end.
Verdict RunWeighing(const Experiment& experiment, const Weighing& weighing);

}  // namespace poise
