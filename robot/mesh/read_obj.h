// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <string_view>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {

/// Reads the vertices and faces of a Wavefront OBJ file from an untrusted
/// source. A face with more than three corners becomes a fan of triangles. An
/// index is counted from 1, or backward from the last vertex if it is negative.
/// Normals, textures, materials, lines and groups are ignored. Vertices that no
/// face uses are kept only if the file has no faces.
///
/// The cost is O(n) in the length, in time and memory.
///
/// @param source  the name of the file in messages.
///
/// Throws Refusal if the file has no vertices, or has an invalid coordinate or
/// index.
TriangleMesh ReadObj(std::string_view text, const std::string& source);

}  // namespace poise
