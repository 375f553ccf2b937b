// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// The points of a body that may touch the ground. The points come from its
/// collision shapes, or from its visual shapes if the collision shapes give no
/// point.
struct Outline {
  /// A point of the body, or a sphere around the point.
  struct Corner {
    int frame;  ///< The link, an index into Tree::frames().
    Eigen::Vector3d p_B;
    double radius;         ///< m.
    bool is_mesh = false;  ///< The point is a vertex of a mesh.
  };
  std::vector<Corner> corners;
  /// The coordinate axes of the body and of its shapes, unit vectors.
  std::vector<Eigen::Vector3d> axes_B;
  /// Why a mesh of the body gives no points: "mesh 'foot.stl' is missing, was
  /// searched in /robots". Empty if no mesh was refused.
  std::string mesh_refusal;
  bool mesh_is_missing = false;  ///< The refused mesh was not found.
};

/// Returns the outline of each body of a robot. Only meshes of bodies that can
/// be feet are opened, with a MeshReader: at least three joints are above the
/// body, and at most two bodies are below it. A mesh that cannot be read is no
/// error; see Outline::mesh_refusal.
std::vector<Outline> MakeOutlines(const RobotModel& model);

/// Returns the outline of the visual shapes of a body that can be a foot, for a
/// foot whose collision shapes have no flat underside. The meshes are opened
/// with a MeshReader.
Outline MakeVisualOutline(const RobotModel& model, int body);

}  // namespace poise
