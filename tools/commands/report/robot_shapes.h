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
  /// Size, m. Box: edge lengths. Ellipsoid: half axes. Cylinder: radius, length
  /// along z, 0. Capsule: radius, length along z without its two half spheres,
  /// 0.
  Eigen::Vector3d size;
  Eigen::Vector4d rgba;
};

/// Returns shapes to draw a robot without its meshes, which are not available.
/// The shapes of a body are the first of these that exist:
///  - the boxes, spheres and cylinders among its visuals,
///  - the boxes, spheres and cylinders among its collisions,
///  - the uniform ellipsoid with the body's inertia, and a capsule from the
///    body's origin to each joint on the body. They are also added if the
///    primitives are too small to be the whole body, such as a sensor on a
///    torso that is a mesh.
/// Shapes of size zero are ignored; some files use them as contact points.
std::vector<BodyShape> MakeBodyShapes(const RobotModel& robot);

}  // namespace poise
