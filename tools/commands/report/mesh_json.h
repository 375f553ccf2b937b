// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {

/// Writes a mesh into a shape of a robot.json: `vertices`, the text
/// "x y z x y z ..." of integers in 0.1 mm, and `triangles`, a text of
/// indices. A text is shorter than an array.
void SetMesh(const TriangleMesh& mesh, nlohmann::json* shape);

}  // namespace poise
