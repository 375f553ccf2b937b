// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/sim/number_field.h"
#include "poise/sim/scenario.h"

namespace poise {

/// Returns the numbers of a part of a scenario, with their keys in the file and
/// their bounds. The fields point into the part.
std::vector<NumberField> Fields(StartSettings* start);
std::vector<NumberField> Fields(ChosenFor* robot);
std::vector<NumberField> Fields(Push* push);
std::vector<NumberField> Fields(ComMotion* com);
std::vector<NumberField> Fields(StanceEvent* event);
std::vector<NumberField> Fields(ControlSettings* control);
std::vector<NumberField> Fields(SensorSettings* s);
std::vector<NumberField> Fields(Scenario* scenario);

}  // namespace poise
