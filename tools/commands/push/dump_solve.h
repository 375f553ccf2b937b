// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>

#include "poise/sim/experiment.h"

namespace poise {

/// Writes the hierarchy that the controller solves at a time of a scenario, s,
/// to FOLDER/solve_TIME.json in the format hqp-1. `//tools:hqp` can replay the
/// file. The function runs the scenario again up to this time. The run is the
/// same to the bit, so the hierarchy is exactly that of the original run.
///
/// Returns the name of the file. Throws std::invalid_argument if the time is
/// not in the scenario, if the file cannot be written, or as ClosedLoop does.
std::filesystem::path DumpSolve(const Experiment& experiment, double time,
                                const std::filesystem::path& folder);

}  // namespace poise
