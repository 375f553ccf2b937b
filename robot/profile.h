// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "math/pose.h"
#include "robot/finding.h"
#include "robot/robot.h"

namespace poise {

/// A sole as a profile gives it.
struct SoleProfile {
  std::string name;                     ///< "left_foot", "right_foot".
  std::string frame;                    ///< Name of a link.
  Pose X_FS;                            ///< z out of the ground, x forward.
  std::vector<Eigen::Vector2d> sole_S;  ///< Corners, m.
  int line;                             ///< In the file.
};

/// What becomes of joints that mimic others. kFree: they are joints like the
/// others. kCoupled: control keeps them where their sources put them. kLocked:
/// they are fixed where the nominal posture puts them.
enum class MimicPolicy { kFree, kCoupled, kLocked };

/// The value of a joint, rad or m, and its line in the file.
struct JointValue {
  double value;
  int line;
};

/// What a URDF does not say of a robot, from a YAML file:
///
///     feet:                      # Left one first. Found, where left out.
///       left_foot:
///         frame: l_sole          # A link.
///         xyz: [0, 0, 0]         # The sole in it: z out of the ground,
///         rpy: [0, 0, 0]         # x forward. Zero where left out.
///         size: [0.23, 0.13]     # Or polygon: [[x, y], ...], in m.
///       right_foot: ...
///     posture:                   # Nominal.
///       found: how
///       base: {xyz: [0, 0, 0.75], rpy: [0, 0, 0]}
///       joints: {l_knee: 0.7}    # The others rest near 0.
///                                # Without base, it is found near the joints.
///     locked: {neck_yaw: 0}      # Joints that the model does without.
///     mimic: coupled             # Or locked, or free, as where left out.
///     tasks: ...                 # For robot/control to read.
struct Profile {
  std::filesystem::path file;
  std::vector<SoleProfile> feet;
  std::optional<Eigen::Vector3d> base_xyz;  ///< The nominal posture is known
  Eigen::Vector3d base_rpy = Eigen::Vector3d::Zero();  ///< if this is.
  std::map<std::string, JointValue> joints;  ///< The others rest near 0.
  std::string posture_found;                 ///< How, in words.
  std::map<std::string, JointValue> locked;
  MimicPolicy mimic = MimicPolicy::kFree;
  YAML::Node tasks;  ///< Undefined where there is none; knows its lines.
};

/// Reads a profile. Throws std::invalid_argument with file, line and what was
/// wanted.
Profile LoadProfile(const std::filesystem::path& file);

/// A robot from its URDF and a profile; an empty Profile will do for a biped
/// whose feet can be found.
///
/// @param findings  as LoadUrdf()'s and FindFeet()'s.
///
/// Throws std::invalid_argument as LoadUrdf(), LoadProfile() and FindFeet(),
/// and where the profile names what the URDF does not have.
Robot LoadRobot(const std::filesystem::path& urdf, const Profile& profile = {},
                std::vector<Finding>* findings = nullptr);

}  // namespace poise
