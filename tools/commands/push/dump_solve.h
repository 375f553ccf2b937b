// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>

#include "poise/sim/experiment.h"

namespace poise {

/// Writes the hierarchy that the controller solves at a time of a scenario, s,
/// for `//tools:hqp` to replay: solve_TIME.json, in the format hqp-1. To that
/// end it runs the scenario again up to there, which is the same to the bit.
///
/// Returns the file. Throws std::invalid_argument if the time is not in the
/// scenario, as ClosedLoop does, or if the file cannot be written.
std::filesystem::path DumpSolve(const Experiment& experiment, double time,
                                const std::filesystem::path& folder);

}  // namespace poise
