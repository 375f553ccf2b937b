// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <vector>

#include "poise/robot/finding.h"

namespace poise {

/// Checks the `<robot>` element of a URDF against the grammar that Poise reads,
/// and removes everything else. Afterwards each attribute has the right count of
/// numbers, or is text, and each child that may occur once occurs once.
/// urdfdom would drop the other elements and attributes silently.
///
/// A bad number is rejected, except in a mesh or a color: these are removed with
/// a warning, as is a second occurrence. An unknown word gives a warning if it
/// looks like a typing error, else a note. An element that xacro should have
/// replaced is rejected if the robot would move differently without it (see
/// HasEssentialPart()), else it is removed with a warning.
void PruneUrdf(tinyxml2::XMLElement* robot, std::vector<Finding>* findings);

}  // namespace poise
