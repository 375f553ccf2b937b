// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/profile/joint_value.h"
#include "poise/robot/profile/sides.h"
#include "poise/robot/profile/sole_profile.h"
#include "poise/robot/robot.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {

/// The treatment of mimic joints.
/// - kFree: a mimic joint moves independently.
/// - kCoupled: control keeps a mimic joint at multiplier * source + offset. If
///   the source is locked, the mimic joint is locked too.
/// - kLocked: a mimic joint is locked at multiplier * source + offset. The
///   value of the source is from `locked`, else from `joints`, else the value
///   at rest.
enum class MimicPolicy { kFree, kCoupled, kLocked };

/// The facts about a robot that its URDF does not contain, read from a YAML
/// file:
///
///     feet:                      # Optional: default is FindFeet().
///       left_foot:
///         frame: l_sole          # A link.
///         xyz: [0, 0, 0]         # Pose of the sole in the link, m and rad:
///         rpy: [0, 0, 0]         # z up, x forward. Default: 0.
///                                # Instead of rpy, normal: [0, 0, 1] gives the
///                                # sole's z axis in the link's axes. The
///                                # sole's x is then near the link's x.
///         size: [0.23, 0.13]     # m. Or polygon: [[x, y], ...], m.
///         from: guess            # Optional: box, mesh or guess, if the sole
///                                # was found by FindFeet(), not measured.
///       right_foot: ...
///     forward: +x                # Axis of the root link that points forward.
///     left: l_foot               # Links of the left and of the right foot.
///     right: r_foot              # These three are optional too: see
///                                # FindFeet().
///     posture:                   # The nominal posture.
///       found: text              # How it was found.
///       base: {xyz: [0, 0, 0.75], rpy: [0, 0, 0]}
///                                # m and rad. Without base, robot/control
///                                # searches for a posture near the joints.
///       joints: {l_knee: 0.7}    # rad or m. Others: 0 or the nearest limit.
///     locked: {neck_yaw: 0}      # Joints to fix and remove from the model.
///     mimic: coupled             # Or locked, or free (the default).
///     tasks: ...                 # Read by robot/control.
struct Profile {
  std::filesystem::path file;
  std::vector<SoleProfile> feet;
  Sides sides;  ///< `forward`, `left` and `right`.
  /// Position of the base in the nominal posture, m. If it is absent, the
  /// profile gives no posture in which the robot can stand.
  std::optional<Eigen::Vector3d> base_xyz;
  Eigen::Vector3d base_rpy = Eigen::Vector3d::Zero();  ///< rad.
  int base_line = 0;                                   ///< Line in the file.
  /// Joints of the nominal posture. Others are at 0 or their nearest limit.
  std::map<std::string, JointValue> joints;
  std::string posture_found;  ///< How the posture was found, a text.
  std::map<std::string, JointValue> locked;
  MimicPolicy mimic = MimicPolicy::kFree;
  /// The `tasks` of the file, with line numbers. Undefined if the file has
  /// none.
  YAML::Node tasks = YAML::Node(YAML::NodeType::Undefined);
};

/// Reads a profile. Throws Refusal with the file, the line, the invalid value
/// and the valid ones.
Profile LoadProfile(const std::filesystem::path& file);

/// Returns the joints that are locked. They are the joints in the profile's
/// `locked`, the mimic joints of locked sources (unless `mimic` is free), and
/// all mimic joints if `mimic` is locked. Further, they are the joints that
/// move no mass (see FindMovedMass()), at their value in `joints` or at rest,
/// and the mimic joints of these that move less than 1 % of the mass. The
/// result can replace `locked` without changing the robot. Throws Refusal if
/// the robot has no such joint, or if a value is outside the joint's limits.
/// Also throws if a coupled joint is in `locked` but its source is not.
std::map<std::string, JointValue> LockedJoints(const RobotModel& model,
                                               const Profile& profile);

/// Returns the names of the joints of LockedJoints() that are locked only
/// because they, or their sources, move no mass. Throws as LockedJoints().
std::vector<std::string> JointsWithoutMass(const RobotModel& model,
                                           const Profile& profile);

/// Makes a model without the joints that LockedJoints() returns. A body without
/// mass between moving joints has the inertia of MakeSmallInertias(), and a
/// point mass that makes M singular has that of MakePointInertias().
/// RobotModel::mimics is empty unless the profile's `mimic` is coupled. Throws
/// as LockedJoints().
RobotModel MakeModel(const UrdfDocument& urdf, const Profile& profile);

/// Makes a robot from its URDF and a profile. An empty Profile is enough for a
/// biped whose feet FindFeet() can find.
///
/// @param findings  if not null, receives the warnings of FindFeet(), of
///                  WarnOfMassless() and of FindSideDefects(), and a warning
///                  about each sole of the profile that is a guess.
///
/// Throws Refusal if the profile does not match the robot: a name is unknown, a
/// joint is outside its limits, `forward`, `left` and `right` contradict the
/// feet, or the posture has a base but the robot cannot stand in the posture.
/// Throws another std::invalid_argument as FindFeet().
Robot MakeRobot(const UrdfDocument& urdf, const Profile& profile,
                std::vector<Finding>* findings = nullptr);

/// Reads a robot from a URDF file, and then works as MakeRobot(). Also throws
/// Refusal as UrdfDocument does.
///
/// @param findings  if not null, receives the findings of UrdfDocument and of
///                  FindFeet().
Robot LoadRobot(const std::filesystem::path& urdf, const Profile& profile = {},
                std::vector<Finding>* findings = nullptr);

}  // namespace poise
