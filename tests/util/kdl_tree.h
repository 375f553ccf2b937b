// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <kdl/jntarray.hpp>
#include <kdl/tree.hpp>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// A tree as Orocos KDL's, for comparison. A floating base hangs on three
/// prismatic joints along the world's axes and three revolute ones, about x, y
/// and z in this order; KDL's joint 0 is the first of them, and the others
/// follow as in the tree. The root of KDL's tree carries no inertia, so a fixed
/// base hangs on a fixed joint.
KDL::Tree MakeKdlTree(const Tree& tree);

/// The name of a body's segment there.
std::string KdlBodyName(int body);

/// KDL's number of each joint of the tree, in the tree's order.
std::vector<int> KdlJoints(const Tree& tree, const KDL::Tree& kdl);

}  // namespace poise
