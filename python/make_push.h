// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include "poise/sim/push.h"

namespace poise {

/// Makes a push in world axes from the arguments of Scenario.add_push() and
/// Simulation.push(). Throws std::invalid_argument if an argument has a wrong
/// type or shape.
/// @param start  s.
Push MakePush(pybind11::handle force, double start, pybind11::handle duration,
              pybind11::handle link, pybind11::handle point,
              pybind11::handle moment, pybind11::handle profile);

}  // namespace poise
