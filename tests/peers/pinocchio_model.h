// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pinocchio/multibody/model.hpp>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// Returns Pinocchio's model of a tree: the same joints, inertias, armatures
/// and gravity, in the same order. A joint along x, y or z has Pinocchio's own
/// type for it. The frames are added in their order, after the joints' own.
pinocchio::Model MakePinocchioModel(const Tree& tree,
                                    const std::vector<Frame>& frames);

}  // namespace poise
