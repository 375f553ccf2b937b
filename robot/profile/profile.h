// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/finding.h"
#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {

/// A sole as a profile gives it.
struct SoleProfile {
  std::string name;                     ///< "left_foot", "right_foot".
  std::string frame;                    ///< Name of a link.
  Pose X_FS;                            ///< z out of the ground, x forward.
  std::vector<Eigen::Vector2d> sole_S;  ///< Corners, m.
  int line;                             ///< In the file.
};

/// The treatment of mimic joints. kFree: a mimic joint moves independently.
/// kCoupled: control keeps a mimic joint at the value that its source gives; if
/// the source is locked, so is the mimic joint. kLocked: a mimic joint is fixed
/// at the value that its source gives in the profile's posture (the source's
/// value in `locked`, else in `joints`, else at rest).
enum class MimicPolicy { kFree, kCoupled, kLocked };

/// The value of a joint, rad or m, and its line in the file.
struct JointValue {
  double value;
  int line;
};

/// The facts about a robot that its URDF does not contain, read from a YAML file:
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
  /// The tasks, with their lines in the file; undefined if there are none.
  YAML::Node tasks = YAML::Node(YAML::NodeType::Undefined);
};

/// Reads a profile. Throws Refusal with the file, the line, the value and what
/// was wanted.
Profile LoadProfile(const std::filesystem::path& file);

/// Returns the joints that a profile fixes: the joints in its `locked`, and the
/// mimic joints that follow them or that its `mimic` locks. The result is also a
/// valid `locked` with the same meaning. Throws Refusal if a joint does not fit
/// the robot.
std::map<std::string, JointValue> LockedJoints(const RobotModel& model,
                                               const Profile& profile);

/// Makes a robot without the joints that the profile locks. Its mimics are those
/// that control couples. Throws as LockedJoints().
RobotModel MakeModel(const UrdfDocument& urdf, const Profile& profile);

/// Makes a robot from its URDF and a profile. An empty Profile is enough for a
/// biped whose feet can be found.
///
/// @param findings  if not null, receives the warnings of FindFeet().
///
/// Throws Refusal if the profile does not fit the robot: a name is unknown, the
/// posture is outside the joint limits, or the posture has a base and the robot
/// cannot stand in it. Throws another std::invalid_argument as FindFeet().
Robot MakeRobot(const UrdfDocument& urdf, const Profile& profile,
                std::vector<Finding>* findings = nullptr);

/// Reads a robot from a URDF file, as MakeRobot(). Throws Refusal also as
/// UrdfDocument does.
///
/// @param findings  if not null, receives the findings of UrdfDocument and of
///                  FindFeet().
Robot LoadRobot(const std::filesystem::path& urdf, const Profile& profile = {},
                std::vector<Finding>* findings = nullptr);

}  // namespace poise
