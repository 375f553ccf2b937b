// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "poise/robot/robot.h"

namespace poise {

/// What a reader of a run's log needs to know of the robot in order to draw it:
/// the tree, shapes, soles and limits.
///
///     format  "poise-robot-1"
///     name, mass (kg)
///     bodies  [{name, parent, joint, type, p, quat, axis}]: body 0 is the base
///             with parent -1 and no joint; p and quat are X_PF, the joint
///             frame on the parent, before the joint's own motion.
///     links   [{name, body, p, quat}]: every link of the URDF, X_BF.
///     shapes  [{body, kind, size, p, quat, rgba}], see BodyShape;
///             kind is "box", "ellipsoid", "cylinder" or "capsule".
///     feet    [{name, body, p, quat, half_size, polygon}], see Foot.
///     limits  {JOINT: {lower, upper, velocity, effort}}, null where infinite.
///
/// Quaternions are (x, y, z, w); SI units.
nlohmann::json MakeRobotJson(const Robot& robot);

}  // namespace poise
