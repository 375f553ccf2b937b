// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/tests/util/recorded_ticks.h"

namespace poise {

/// Returns a problem, followed by `num_changed` problems that differ little
/// from it, so that a solver can start warm. In each of these, every target b
/// is multiplied by a random number from 0.99 to 1.01. If `changes_bounds`,
/// both bounds of every inequality are also shifted by a random number from
/// -0.01 to 0.01. The numbers are the same on every platform.
RecordedTicks MakeChangedTicks(const Hierarchy& hierarchy,
                               const std::vector<LevelCapacity>& capacity,
                               int num_changed, bool changes_bounds);

}  // namespace poise
