// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/sim/judge.h"

namespace poise {

/// "recovers", "falls at 1.06 s", or, of a robot that stays up elsewhere, "does
/// not come back".
std::string Outcome(const Verdict& verdict);

}  // namespace poise
