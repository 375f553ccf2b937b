// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf_tree_check.h"

namespace poise {

/// Contents of a URDF that are read directly from the XML, because urdfdom does
/// not keep them.
struct UrdfFacts {
  UrdfTree tree;  ///< The robot, without links that represent the world.
  std::map<std::string, JointLimits> limits;  ///< Limits of the moving joints.
};

/// Checks a URDF that was parsed as XML, and removes all parts that Poise does
/// not read (see PruneUrdf()). If no finding has Severity::kReject, the file is
/// a tree of links and joints with finite numbers and a positive total mass.
UrdfFacts CheckUrdf(tinyxml2::XMLDocument* document,
                    std::vector<Finding>* findings);

}  // namespace poise
