// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <utility>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// The pairs of bodies (smaller first) whose shapes overlap by construction and
/// so must not collide: those that a joint parts, or several joints that lie
/// so close together that they are as one (a hip's thigh is the pelvis's
/// neighbor, whatever lies between), and those that share a parent.
std::vector<std::pair<int, int>> FindNeighbors(const Tree& tree);

}  // namespace poise
