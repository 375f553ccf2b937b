// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <string_view>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {

/// Reads an STL file, binary or text, from an untrusted source. Each triangle
/// has three vertices of its own. Normals are ignored.
///
/// A file is binary if its length fits the number of triangles at byte 80, if
/// it does not begin with `solid`, or if its first 84 bytes contain a zero.
/// Some binary files also begin with `solid`. Bytes after the last triangle of
/// a binary file are ignored. The words of a text may have capital letters, and
/// UTF-8's byte order mark may precede them.
///
/// The cost is O(n) in the length, in time and memory.
///
/// @param source  the name of the file in messages.
///
/// Throws Refusal if the file is truncated, has no triangle or has a coordinate
/// that is not finite.
TriangleMesh ReadStl(std::string_view bytes, const std::string& source);

}  // namespace poise
