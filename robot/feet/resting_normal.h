// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "poise/robot/feet/outline.h"

namespace poise {

/// Returns the up normal of the plane on which the meshes of a body rest: the
/// supporting plane below the middle of their vertices, seen from above. It is
/// a facet of the lower side of their convex hull. Returns nothing if the body
/// has no meshes, or if the facet is not unique because the vertices lie in a
/// vertical plane.
///
/// The cost is O(n) in the number of vertices for each of about ten steps.
std::optional<Eigen::Vector3d> RestingNormal(const Outline& outline,
                                             const Eigen::Vector3d& up_B);

}  // namespace poise
