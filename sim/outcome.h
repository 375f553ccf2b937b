// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/sim/judge.h"

namespace poise {

/// Returns "recovers", "falls at 1.06 s", or "does not come back" for a robot
/// that stays up but ends too far from the desired place.
std::string Outcome(const Verdict& verdict);

}  // namespace poise
