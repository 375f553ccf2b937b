// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/stance.h"
#include "poise/robot/control/tick_report.h"
#include "poise/robot/gait/gait.h"
#include "poise/sim/observation.h"
#include "poise/sim/plants/plant.h"

namespace poise {

/// Everything that a recorder writes about one tick. Refers to data of the
/// object that made the record, so it is valid only until the next tick.
struct TickRecord {
  long tick;
  const Observation& observation;
  const PlantState& start;     ///< State when the tick began.
  const PlantState& end;       ///< State when it ended; mean forces during it.
  const Eigen::VectorXd& tau;  ///< Torques of the controller.
  Eigen::Vector3d push_force_W;  ///< Mean over the tick, N.
  const Stack& stack;
  const Hierarchy& hierarchy;  ///< Problem of this tick.
  const TickReport& report;
  const Stance& stance;  ///< Phases of the contacts in the controller.
  const Gait* gait;      ///< Null without steps.
  int nv;
  double microseconds;  ///< Computing time of the controller.
};

}  // namespace poise
