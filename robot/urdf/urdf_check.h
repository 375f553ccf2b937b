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

/// The facts that are read from the XML itself, because urdfdom drops them.
struct UrdfFacts {
  UrdfTree tree;  ///< The robot, without links that stand for the world.
  std::map<std::string, JointLimits> limits;  ///< Of moving joints.
};

/// Checks a URDF that was parsed as XML, and removes all parts that Poise does
/// not read (see PruneUrdf()). A file without a finding of Severity::kReject is
/// a tree of links and joints with finite numbers and a positive total mass.
UrdfFacts CheckUrdf(tinyxml2::XMLDocument* document,
                    std::vector<Finding>* findings);

}  // namespace poise
