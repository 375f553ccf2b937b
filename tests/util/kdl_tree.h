// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <kdl/jntarray.hpp>
#include <kdl/tree.hpp>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// Converts a tree to Orocos KDL, for comparison. A floating base hangs on
/// three prismatic joints along the world's axes and three revolute ones about
/// x, y and z, in this order. KDL's joint 0 is the first of these six. The root
/// of KDL's tree has no inertia, so a fixed base hangs on a fixed joint.
KDL::Tree MakeKdlTree(const Tree& tree);

/// Returns the name of a body's segment in KDL's tree.
std::string KdlBodyName(int body);

/// Returns KDL's index of each joint, in the tree's order of joints.
std::vector<int> KdlJoints(const Tree& tree, const KDL::Tree& kdl);

}  // namespace poise
