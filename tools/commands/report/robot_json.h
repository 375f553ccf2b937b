// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "poise/robot/robot.h"

namespace poise {

/// Returns the data that are needed to draw the robot of a log: its tree,
/// shapes, soles and limits.
///
///     format  "poise-robot-1"
///     name, mass (kg)
///     bodies  [{name, parent, joint, type, p, quat, axis}]: body 0 is the base
///             with parent -1 and no joint. p and quat are X_PF, the joint
///             frame on the parent at joint position 0.
///     links   [{name, body, p, quat}]: every link of the URDF; p and quat are
///             X_BF.
///     shapes  [{body, kind, size, p, quat, rgba}], see BodyShape;
///             kind is "box", "ellipsoid", "cylinder", "capsule" or "mesh".
///             A mesh also has the data of SetMesh(). `stand_in` is true if
///             the shape is not one of the visuals.
///     feet    [{name, body, p, quat, half_size, polygon}], see Foot.
///     limits  {JOINT: {lower, upper, velocity, effort}}; null if infinite.
///     unread_meshes  [{body, file, scale, p, quat, rgba}]: meshes of the
///             visuals without Mesh::surface. Left out, with `urdf`, the path
///             of the URDF, if there are none.
///
/// Quaternions are in the order (x, y, z, w). Units are SI.
nlohmann::json MakeRobotJson(const Robot& robot);

}  // namespace poise
