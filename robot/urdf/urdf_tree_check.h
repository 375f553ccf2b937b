// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "robot/urdf/urdf_xml.h"

namespace poise {

/// The names of a robot's links and joints, in the file's order.
struct UrdfTree {
  std::string base;  ///< The link that floats.
  std::vector<std::string> links;
  std::vector<std::string> joints;
};

/// Checks that a URDF's joints make one tree of its links: one root, one parent
/// each, all connected. Then finds the base, and leaves out of the names what
/// stands for the world: massless links, one below the other, down to a floating
/// joint. Any other floating joint is rejected, and so is a robot without mass.
/// @param tree  in: links and joints; out: base, and less of both.
void CheckTree(const tinyxml2::XMLElement& robot, const Elements& links,
               const Elements& joints, const Critic& critic, UrdfTree* tree);

}  // namespace poise
