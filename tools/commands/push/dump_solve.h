// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

#include "poise/sim/experiment.h"

namespace poise {

/// The ticks of a run whose hierarchies are written: those nearest to these
/// times, s, and all between them.
struct DumpedTicks {
  double first, last;
};

/// Writes the hierarchy that the controller solves at the time `last` of a
/// scenario to FOLDER/solve_TIME.json in the format hqp-1. If `first` is
/// earlier, writes one file a tick to FOLDER/solves_FIRST_LAST instead, in the
/// order of their names; earlier files there are removed. `//tools:hqp` solves
/// the files again. The function runs the scenario up to `last`. Without a
/// budget by the clock, the run is the same to the bit, so the hierarchies are
/// exactly those of the original run. Solved in order from the first tick of
/// the run, with the same budget, they give the same answers, if no tick failed
/// safe.
///
/// Returns the name of the file, or `solves_FIRST_LAST/solve_*.json`. Throws
/// std::invalid_argument if a time is not in the scenario, if `first` is after
/// `last`, if a file cannot be written, or as ClosedLoop does.
std::filesystem::path DumpSolve(const Experiment& experiment,
                                const DumpedTicks& ticks,
                                const std::filesystem::path& folder);

/// Returns the command that solves the dumped ticks again as the controller
/// did. It has the run's budget only if the ticks begin with the first one of
/// the run, because a budget is for solves that continue the one before.
///
/// @param dumped  what DumpSolve() returned.
std::string SolveAgain(const ControlSettings& control, const DumpedTicks& ticks,
                       const std::filesystem::path& dumped);

}  // namespace poise
