// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/robot/feet/sole_source.h"

namespace poise {

/// The limits of one joint. A limit that the file does not give is infinite.
struct JointLimits {
  double lower;         ///< rad or m.
  double upper;         ///< rad or m.
  double velocity;      ///< rad/s or m/s.
  double effort;        ///< N m or N.
  double damping = 0;   ///< N m s/rad or N s/m.
  double friction = 0;  ///< N m or N.
};

/// A coupling q[joint] = multiplier q[source] + offset, with indices into
/// Tree::joints().
struct MimicCoupling {
  int joint;
  int source;
  double multiplier;
  double offset;
};

/// A sphere. As for Box and Cylinder, its center is the origin of the shape's
/// frame. Sizes are in m.
struct Sphere {
  double radius;
};
/// See Sphere.
struct Box {
  Eigen::Vector3d size;  ///< Full edge lengths.
};
/// See Sphere.
struct Cylinder {
  double radius;
  double length;  ///< Along z, centered.
};
struct TriangleMesh;  // In robot/mesh/triangle_mesh.h.
/// A surface from a file, in the frame of the file.
struct Mesh {
  std::string file;  ///< As in the URDF: "package://NAME/foot.stl".
  Eigen::Vector3d scale;
  /// The surface in m, scaled, for drawing. Null unless ReadVisuals() found it.
  std::shared_ptr<const TriangleMesh> surface = nullptr;
};
using Geometry = std::variant<Sphere, Box, Cylinder, Mesh>;

/// A shape that is fixed to a link.
struct Shape {
  int frame;  ///< The link, an index into Tree::frames().
  Pose X_FS;  ///< The pose of the shape in the link.
  Geometry geometry;
  Eigen::Vector4d rgba{0.7, 0.7, 0.7, 1};
};

/// The places where the mesh files of a robot are searched, see FindMesh().
struct MeshPlaces {
  /// The URDF file. If it is empty, no mesh is searched.
  std::filesystem::path urdf;
  std::vector<std::filesystem::path> packages;  ///< The folders of packages.
};

/// The contents of a URDF: the tree, and the data for control and drawing.
struct RobotModel {
  std::string name;
  Tree tree;
  std::vector<JointLimits> limits;  ///< One entry per joint of the tree.
  std::vector<MimicCoupling> mimics;
  std::vector<Shape> visuals;
  std::vector<Shape> collisions;
  int root_frame;  ///< The link that carries the base.
  MeshPlaces mesh_places = {};
};

/// A flat sole. The contact frame C lies at the center of the largest rectangle
/// in the sole polygon. Its z axis points out of the ground, its x axis
/// forward.
struct Foot {
  std::string name;           ///< "left_foot", "right_foot".
  int body;                   ///< Index of the body in the tree.
  int frame;                  ///< The foot's link, an index in Tree::frames().
  Pose X_BC;                  ///< Contact frame in the body.
  Eigen::Vector2d half_size;  ///< Half of the rectangle's sides, x and y, m.
  std::vector<Eigen::Vector2d> polygon_C;  ///< Convex, counterclockwise, m.
  /// The origin of the sole. It is absent if a profile gives the sole.
  std::optional<SoleSource> source = std::nullopt;
};

/// A robot for control and simulation. It combines the contents of the URDF
/// with the feet and the posture of the profile.
struct Robot {
  RobotModel model;
  std::vector<Foot> feet;  ///< The left foot, then the right foot.
  /// The nominal posture. The soles are on the ground (z = 0), their midpoint
  /// is at the world's origin, and the robot faces +x. For the layout see Tree.
  Eigen::VectorXd q_nominal;
  /// Whether the robot can stand in q_nominal. If false, the joints are at the
  /// profile's values, else at zero or at their nearest limit. The base is then
  /// at the origin, and robot/control can search for a posture.
  bool can_stand = false;
};

}  // namespace poise
