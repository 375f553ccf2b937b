// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "poise/robot/feet/outline.h"

namespace poise {

/// Returns the up normal of the plane on which a body rests, or on which its
/// meshes alone rest: the supporting plane below the middle of their corners,
/// seen from above. It is a facet of the lower side of their convex hull. A
/// sphere counts as its lowest point. Returns nothing if there are no corners,
/// or if the facet is not unique because the corners lie in a vertical plane.
///
/// The cost is O(n) in the number of vertices for each of about ten steps.
std::optional<Eigen::Vector3d> RestingNormal(const Outline& outline,
                                             const Eigen::Vector3d& up_B,
                                             bool only_meshes);

}  // namespace poise
