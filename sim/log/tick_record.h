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

/// All data of one tick for the recorder. The references are valid during the call
/// only.
struct TickRecord {
  long tick;
  const Observation& observation;
  const PlantState& start;       ///< When the tick began.
  const PlantState& end;         ///< When it ended, with what acted during it.
  const Eigen::VectorXd& tau;    ///< Torques of the controller.
  Eigen::Vector3d push_force_W;  ///< Mean over the tick, N.
  const Stack& stack;
  const Hierarchy& hierarchy;  ///< Problem of this tick.
  const TickReport& report;
  const Stance& stance;  ///< Contacts, as the controller's stance has them.
  int nv;
  double microseconds;  ///< That the controller took.
};

}  // namespace poise
