// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "robot/finding.h"
#include "robot/robot.h"

namespace poise {

/// What is read from the XML of a URDF itself, as urdfdom does not keep it.
struct UrdfFacts {
  std::string base;                 ///< The link that floats.
  std::vector<std::string> links;   ///< Of the robot, in the file's order.
  std::vector<std::string> joints;  ///< Likewise.
  std::map<std::string, JointLimits> limits;  ///< Of moving joints.
};

/// Checks a URDF, already parsed as XML, and prunes it to what is read (see
/// PruneUrdf()). A file without a finding of Severity::kReject is a tree of
/// links and joints with finite numbers. Massless links above a floating joint,
/// and that joint, stand for the world and are left out.
UrdfFacts CheckUrdf(tinyxml2::XMLDocument* document,
                    std::vector<Finding>* findings);

}  // namespace poise
