// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <vector>

#include "poise/robot/finding.h"

namespace poise {

/// Checks the `<robot>` element of a URDF against the grammar that Poise reads,
/// and removes everything else. Afterwards each attribute is a text, or has the
/// right count of numbers. Each child that must not repeat occurs at most once.
/// urdfdom would ignore the other elements and attributes without a message.
///
/// - An invalid number is a reason to reject the file. Exception: a mesh or a
///   color with an invalid number is removed with a warning.
/// - If an element repeats that must not, only the first is kept, with a
///   warning.
/// - An unknown name gives a warning if it looks like a typing error, else a
///   note.
/// - An element that xacro should have replaced is a reason to reject the file
///   if the robot would move differently without it (see HasEssentialPart()).
///   Other such elements are removed with a warning.
void PruneUrdf(tinyxml2::XMLElement* robot, std::vector<Finding>* findings);

}  // namespace poise
