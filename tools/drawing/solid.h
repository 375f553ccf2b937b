// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/tools/commands/report/robot_shapes.h"

namespace poise {

/// A flat piece of a surface. Seen from outside, its corners are in
/// counterclockwise order.
struct Facet {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d normal;  ///< Unit vector, outwards.
};

/// Returns the surface of a shape, in the axes of the shape. The facets form a
/// closed convex polyhedron whose corners lie on the exact surface. Exception:
/// each triangle of a mesh gives two facets, one for each side, because meshes
/// have holes and triangles in the wrong order.
std::vector<Facet> MakeFacets(const BodyShape& shape);

}  // namespace poise
