// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "poise/robot/collision/capsule.h"
#include "poise/robot/robot.h"

namespace poise {

/// Largest number of capsules of a body.
constexpr size_t kMostCapsules = 4;

/// Points on the surface of each body, by body of the tree and in its frame:
/// the vertices of its meshes, m. An empty list means that no body has any.
using SurfacePoints = std::vector<std::vector<Eigen::Vector3d>>;

/// Returns the capsules of each body, by body of the tree and in its frame.
/// They contain the body's collision shapes; without such shapes its visual
/// shapes; without any shape, the segments from its joint to its children's
/// joints, with a radius of a tenth of the length. A mesh counts only by its
/// points.
///
/// A link inside a compound joint, such as a hip of three joints, has no
/// capsules: a body without collision shapes whose children's joints are within
/// 5 % of the reach. Its neighbors cover it.
///
/// A body has one capsule, or one for each shape if these stand out much less.
/// A thick box has up to four. Fingers and the like, whose subtree has less
/// than 0.5 % of the mass, have no capsules: their shapes at q = 0 belong to
/// the body that carries them, if it has shapes at all.
///
/// Throws std::invalid_argument if a number of a shape is not finite.
/// For setup: costs about a microsecond per point.
std::vector<std::vector<Capsule>> FitBodyCapsules(
    const RobotModel& model, const SurfacePoints& points = {});

/// Length of the longest chain of joints, from the base to a body, m: the scale
/// of distances on this robot.
double Reach(const Tree& tree);

}  // namespace poise
