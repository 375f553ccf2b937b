// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/feet/outline.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/robot.h"

namespace poise {

/// A flat underside of a body. B is the body's frame.
struct Sole {
  int frame = 0;  ///< The link, an index into Tree::frames().
  Eigen::Vector3d normal_B = Eigen::Vector3d::Zero();  ///< Out of the ground.
  std::vector<Eigen::Vector3d> points_B;               ///< All in one plane.
  double area = 0;                                     ///< m².
  SoleSource source = SoleSource::kBox;
};

/// Finds the largest flat underside of a body. The candidate planes are normal
/// to one of the outline's axes or to `up_B`, or are the plane on which the
/// meshes of the body rest. If their areas are below that of a square of a side
/// of 0.05 of the leg, the plane on which all shapes rest is one, too. They are
/// at most 35 degrees from horizontal. The plane that has the largest area
/// within 2 mm above it is chosen. The result has no points if no such plane
/// has an area.
///
/// The points of the result are projections onto the plane: of corners at most
/// 2 mm above it, and of vertices of meshes at most 6 mm above it. Soles have
/// rounded edges and profiles, and rubber is soft. With a leg below 0.2 m, the
/// two bounds are 1 % and 3 % of the leg. With a leg above 1 m, they are 0.2 %
/// and 0.6 % of the leg.
///
/// @param leg  the length of the leg, m.
Sole FindSole(const Outline& outline, const Eigen::Vector3d& up_B, double leg);

/// Estimates the sole of a foot whose meshes cannot be read, as FindFeet()
/// describes.
///
/// @param p_BA_B  the position of the ankle in the body, m.
/// @param leg     the length of the leg, m.
Sole EstimateSole(const RobotModel& model, int body,
                  const Eigen::Vector3d& up_B, const Eigen::Vector3d& forward_B,
                  const Eigen::Vector3d& p_BA_B, double leg);

/// Returns why a mesh of the body is not read, and the remedy, as part of a
/// warning: "because mesh a.stl: is missing, ..."
///
/// @pre outline.mesh_refusal is not empty.
std::string WhyWithoutMesh(const Outline& outline);

/// Returns the reason for an estimate, as part of a warning: "because mesh
/// a.stl: is missing, ...", or the shapes that have no flat underside.
std::string WhyEstimated(const Outline& outline);

/// Returns the pose of the sole frame S in the body. Its origin is the
/// projection of the body's origin onto the plane of the sole. Its z axis is
/// the normal. Its x axis points forward, along an axis of the outline if one
/// is within 0.3 rad.
Pose MakeSoleAxes(const Sole& sole, const Outline& outline,
                  const Eigen::Vector3d& forward_B);

}  // namespace poise
