// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <string>

#include "poise/robot/mesh/triangle_mesh.h"

namespace poise {

/// Reads a mesh file of a format such as COLLADA (.dae), PLY or glTF from an
/// untrusted source. The command `assimp` of Debian's package assimp-utils
/// reads the file in a child process, because a broken file may crash assimp.
/// Collada's unit is applied. Its up axis is ignored, as RViz does: robot files
/// expect the axes in which the mesh was drawn.
///
/// @param seconds  bound on the time of the child process.
///
/// The child process has at most 1 GiB of memory. Throws Refusal if the command
/// is not installed, cannot read the file, or exceeds a bound.
TriangleMesh ConvertMesh(const std::filesystem::path& file, double seconds);

}  // namespace poise
