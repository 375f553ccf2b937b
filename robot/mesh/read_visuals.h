// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Reads the meshes of a robot's visuals for drawing, and sets Mesh::surface.
/// All surfaces together have about 24000 triangles, see SimplifyMesh(). A mesh
/// that cannot be read keeps no surface. The bounds of MeshReader apply.
///
/// Returns how many meshes cannot be read.
int ReadVisuals(RobotModel* model);

/// Does the same for these meshes of one robot.
int ReadSurfaces(const MeshPlaces& places, const std::vector<Mesh*>& meshes);

}  // namespace poise
