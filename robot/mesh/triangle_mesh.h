// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// A surface of triangles, in the axes and the unit of its file. All
/// coordinates are finite.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  /// Indices into `vertices`. A file with points only has no triangles.
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace poise
