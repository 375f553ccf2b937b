// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/robot.h"

namespace poise {

enum class BodyShapeKind { kBox, kEllipsoid, kCylinder, kCapsule };

/// A shape to draw, fixed in a body of the tree.
struct BodyShape {
  int body;
  Pose X_BS;
  BodyShapeKind kind;
  /// Box: edge lengths. Ellipsoid: half axes. Cylinder: radius, length along z,
  /// 0. Capsule: the same, the length without its two half balls. m.
  Eigen::Vector3d size;
  Eigen::Vector4d rgba;
};

/// The robot as something to look at, although its meshes are not at hand. Each
/// body is drawn by the first of these that says anything of it:
///  - the boxes, spheres and cylinders among its visuals,
///  - those among its collisions,
///  - the uniform ellipsoid that has its inertia, and a capsule from its origin
///    to each joint it carries. They are also added to primitives so small (a
///    sensor on a torso that is a mesh) that they cannot be the body itself.
/// Shapes without extent, of which some files make contact points, are left out.
std::vector<BodyShape> MakeBodyShapes(const RobotModel& robot);

}  // namespace poise
