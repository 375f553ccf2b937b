// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {

/// Returns a box with edges along the axes, as 12 triangles. Seen from outside,
/// their corners are counterclockwise.
TriangleMesh BoxMesh(const Eigen::Vector3f& low, const Eigen::Vector3f& high);

/// Returns the contents of a binary STL file.
///
/// @param header  the beginning of the 80 bytes before the count.
std::string BinaryStl(const TriangleMesh& mesh, const std::string& header = "");

/// Returns the contents of a text STL file.
std::string TextStl(const TriangleMesh& mesh);

/// Returns the contents of an OBJ file.
std::string Obj(const TriangleMesh& mesh);

/// Returns the contents of a COLLADA file.
///
/// @param meter    the length of the file's unit, m.
/// @param up_axis  "X_UP", "Y_UP" or "Z_UP".
std::string Collada(const TriangleMesh& mesh, double meter,
                    const std::string& up_axis);

}  // namespace poise
