// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise::tolerances {

/// A row is at its bound within kAtBound (|C_i| |y| + |bound|); beyond that it
/// is violated, and its multiplier is free. This is a term of the definition of
/// a Certificate, which solver, reference and certifier have to share. Rounding
/// gives 1e-15, so six digits remain for badly conditioned rows.
constexpr double kAtBound = 1e-9;

/// The error of a level's cost is relative to the cost plus kZeroCost times the
/// cost of the magnitudes of its terms. This too is a term of the definition of
/// a Certificate. A level that is met to rounding has 1e-30 of these, so 1e-9
/// divides no rounding by rounding.
constexpr double kZeroCost = 1e-9;

}  // namespace poise::tolerances
