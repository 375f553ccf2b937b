// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <utility>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// Returns the pairs of bodies (smaller index first) whose shapes overlap by
/// construction, so that they must not collide. These are bodies connected by a joint
/// or by several joints that are close together, as pelvis and thigh by a hip, and
/// bodies with the same parent.
std::vector<std::pair<int, int>> FindNeighbors(const Tree& tree);

}  // namespace poise
