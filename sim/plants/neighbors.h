// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <utility>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// Returns the pairs of bodies, smaller index first, whose shapes overlap by
/// construction and so must not collide:
/// - bodies connected by one joint, or by several joints within 5 cm or, if
///   that is longer, 5.5 % of the robot's reach, see Reach() (the thigh is a
///   neighbor of the pelvis, although hip bodies are between them);
/// - bodies with the same parent.
std::vector<std::pair<int, int>> FindNeighbors(const Tree& tree);

}  // namespace poise
