// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "robot/finding.h"
#include "robot/robot.h"
#include "robot/urdf/urdf_tree_check.h"

namespace poise {

/// What is read from the XML of a URDF itself, as urdfdom does not keep it.
struct UrdfFacts {
  UrdfTree tree;  ///< Of the robot: without what stands for the world.
  std::map<std::string, JointLimits> limits;  ///< Of moving joints.
};

/// Checks a URDF, already parsed as XML, and prunes it to what is read (see
/// PruneUrdf()). A file without a finding of Severity::kReject is a tree of
/// links and joints with finite numbers.
UrdfFacts CheckUrdf(tinyxml2::XMLDocument* document,
                    std::vector<Finding>* findings);

}  // namespace poise
