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
/// others. kCoupled: control keeps them where their sources put them; if those
/// are locked, so are they. kLocked: they are fixed where their sources put them
/// in the profile's posture (in its `locked`, else its `joints`, else at rest).
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
///                                # Or normal: [0, 0, 1], z in the link's axes;
///                                # x is then as near the link's x as can be.
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
  int base_line = 0;                                   ///< In the file.
  std::map<std::string, JointValue> joints;  ///< The others rest near 0.
  std::string posture_found;                 ///< How, in words.
  std::map<std::string, JointValue> locked;
  MimicPolicy mimic = MimicPolicy::kFree;
  /// Undefined where there is none; knows its lines.
  YAML::Node tasks = YAML::Node(YAML::NodeType::Undefined);
};

/// Reads a profile. Throws Refusal with file, line, the value and what was
/// wanted.
Profile LoadProfile(const std::filesystem::path& file);

/// The joints that a profile fixes: those in its `locked`, and the mimics that it
/// has follow them or be fixed. In a profile's `locked`, all of them say the same
/// again. Throws Refusal where they do not fit the robot.
std::map<std::string, JointValue> LockedJoints(const RobotModel& model,
                                               const Profile& profile);

/// What a profile leaves of a robot: its joints without LockedJoints(), and of
/// the mimics those that control couples. Throws as LoadUrdf() and LockedJoints().
RobotModel LoadModel(const std::filesystem::path& urdf, const Profile& profile);

/// A robot from its URDF and a profile; an empty Profile will do for a biped
/// whose feet can be found.
///
/// @param findings  as FindFeet()'s.
///
/// Throws Refusal as LoadUrdf(), and where the profile does not fit the robot:
/// where it names what that does not have, or gives a posture that is outside
/// its limits or, with a base, not one to stand in. Throws another
/// std::invalid_argument as FindFeet().
Robot LoadRobot(const std::filesystem::path& urdf, const Profile& profile = {},
                std::vector<Finding>* findings = nullptr);

}  // namespace poise
