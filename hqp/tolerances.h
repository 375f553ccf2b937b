// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise::tolerances {

/// A row is at its bound within kAtBound (|C_i| |y| + |bound|); beyond that it
/// is violated, and its multiplier is free. This is a term of the definition of
/// a Certificate, which solver, reference and certifier have to share. Rounding
/// gives 1e-15, so six digits remain for badly conditioned rows.
constexpr double kAtBound = 1e-9;

}  // namespace poise::tolerances
