// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <vector>

#include "robot/finding.h"

namespace poise {

/// Checks the `<robot>` element of a URDF against the grammar of what Poise
/// reads, and takes away the rest: afterwards each attribute that is there is
/// what it must be (so many numbers, or text), and a child that may be there
/// once is there once. What urdfdom would drop without a word is found here.
///
/// Bad numbers are rejected, but for those of a mesh or a color: these are taken
/// away with a warning, as is what is there a second time. A word that looks
/// like a slip of the pen is a warning too, others are notes.
void PruneUrdf(tinyxml2::XMLElement* robot, std::vector<Finding>* findings);

}  // namespace poise
