// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/stance.h"
#include "poise/robot/control/tick_report.h"
#include "poise/sim/observation.h"
#include "poise/sim/plants/plant.h"

namespace poise {

/// One tick, as it happened: what a recorder writes. Refers to what its maker
/// owns, for the length of a call.
struct TickRecord {
  long tick;
  const Observation& observation;
  const PlantState& start;       ///< When the tick began.
  const PlantState& end;         ///< When it ended, with what acted during it.
  const Eigen::VectorXd& tau;    ///< What the controller asked for.
  Eigen::Vector3d push_force_W;  ///< The mean over the tick, N.
  const Stack& stack;
  const Hierarchy& hierarchy;  ///< What the controller solved.
  const TickReport& report;
  const Stance& stance;  ///< Of the feet, by the controller.
  int nv;
  double microseconds;  ///< That the controller took.
};

}  // namespace poise
