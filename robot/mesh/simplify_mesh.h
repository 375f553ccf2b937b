// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {

/// Returns a mesh of at most `most_triangles` triangles for drawing, or of at
/// most four. Equal vertices become one. If triangles are still too many, the
/// vertices in each cell of a grid become their mean, and triangles without
/// area are left out. The cells grow until the triangles are few enough, so
/// that the surface moves by about one cell.
///
/// The cost is O(n log n).
TriangleMesh SimplifyMesh(const TriangleMesh& mesh, std::size_t most_triangles);

}  // namespace poise
