// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/mesh/triangle_mesh.h"
#include "poise/robot/robot.h"

namespace poise {

enum class BodyShapeKind { kBox, kEllipsoid, kCylinder, kCapsule, kMesh };

/// A shape to draw, fixed in a body of the tree.
struct BodyShape {
  int body;
  Pose X_BS;
  BodyShapeKind kind;
  /// Size, m. Box: edge lengths. Ellipsoid: half axes. Cylinder: radius, length
  /// along z, 0. Capsule: radius, length along z without its two half spheres,
  /// 0. Mesh: not used.
  Eigen::Vector3d size;
  Eigen::Vector4d rgba;
  /// The surface if the kind is kMesh, else null.
  std::shared_ptr<const TriangleMesh> mesh = nullptr;
  bool is_stand_in = false;  ///< The shape is not one of the robot's visuals.
};

/// Returns shapes to draw a robot. The shapes of a body are the first of these
/// that exist:
///  - the boxes, spheres and cylinders among its visuals, and its meshes that
///    ReadVisuals() has read,
///  - the boxes, spheres and cylinders among its collisions,
///  - the uniform ellipsoid with the body's inertia, and a capsule from the
///    body's origin to each joint on the body. They are also added if the
///    primitives are too small to be the whole body, such as a sensor on a
///    torso that is a mesh. They are not added if the body has meshes and all
///    of them have been read.
/// If a mesh of a body has not been read, a capsule to each joint fills the
/// gaps that the other shapes leave. An ellipsoid is at most as large as the
/// distance from its center to the body's joints, or 15 % of the robot, because
/// some files have inertias of much larger bodies. Shapes of size zero are
/// ignored; some files use them as contact points.
std::vector<BodyShape> MakeBodyShapes(const RobotModel& robot);

}  // namespace poise
