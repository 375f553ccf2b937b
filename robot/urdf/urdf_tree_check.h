// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "poise/robot/urdf/urdf_xml.h"

namespace poise {

/// The names of a robot's links and joints, in the file's order.
struct UrdfTree {
  std::string base;  ///< The link that is the floating base.
  std::vector<std::string> links;
  std::vector<std::string> joints;
};

/// Checks that the joints of a URDF connect its links to one tree: one root,
/// one parent for each other link, no cycle. Then finds the base, and removes
/// the names of massless links from the root down to a floating joint, because
/// they represent the world. Rejects any other floating joint, and a robot
/// without mass.
///
/// @param tree  in: the names of all links and joints; out: the base, and the
///              names that remain.
void CheckTree(const tinyxml2::XMLElement& robot, const Elements& links,
               const Elements& joints, const Critic& critic, UrdfTree* tree);

}  // namespace poise
