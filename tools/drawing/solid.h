// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/tools/commands/report/robot_shapes.h"

namespace poise {

/// A flat piece of a surface, its corners counterclockwise seen from outside.
struct Facet {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d normal;  ///< Unit, outwards.
};

/// The surface of a shape in the shape's own axes: closed and convex, its
/// corners on the true surface.
std::vector<Facet> MakeFacets(const BodyShape& shape);

}  // namespace poise
