// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise::tolerances {

/// A row is at its bound within kAtBound (|C_i| |y| + |bound|). Beyond that the
/// row is violated, and its multiplier is free. This margin is part of the
/// definition of a Certificate, so the solver, the reference and the certifier
/// share it. Rounding gives 1e-15, so six digits remain for badly conditioned
/// rows.
constexpr double kAtBound = 1e-9;

/// The error of a level's cost is relative to the cost plus kZeroCost times the
/// cost of the magnitudes of its terms. This too is part of the definition of a
/// Certificate. The cost of a level that is met to rounding is 1e-30 of the
/// latter, so 1e-9 avoids the quotient of two rounding errors.
constexpr double kZeroCost = 1e-9;

}  // namespace poise::tolerances
