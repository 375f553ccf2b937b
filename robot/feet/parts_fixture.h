// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <sstream>
#include <string>
#include <vector>

#include "poise/math/rpy.h"

namespace poise {

/// A link of a robot that a test generates, and the joint that moves the link.
struct Part {
  std::string link;
  std::string parent;
  Eigen::Vector3d xyz;      ///< Joint on the parent, m.
  Eigen::Vector3d axis;     ///< Of the joint.
  double mass = 1;          ///< kg.
  std::string shapes = "";  ///< URDF elements.
  double effort = 9;        ///< N m.
  double lower = -1;        ///< rad.
  double upper = 1;         ///< rad.
};

inline std::string Numbers(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text.precision(17);
  text << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

/// Returns a collision shape, such as "box size='0.2 0.1 0.02'".
inline std::string ShapeAt(const std::string& geometry,
                           const Eigen::Vector3d& xyz) {
  return "<collision><origin xyz='" + Numbers(xyz) + "'/><geometry><" +
         geometry + "/></geometry></collision>";
}

inline std::string InertialOf(double mass, const Eigen::Vector3d& com) {
  const std::string m = std::to_string(mass);
  return "<inertial><origin xyz='" + Numbers(com) + "'/><mass value='" + m +
         "'/><inertia ixx='" + m + "' ixy='0' ixz='0' iyy='" + m +
         "' iyz='0' izz='" + m + "'/></inertial>";
}

/// Returns a URDF with the root link `trunk` and the parts.
///
/// @param R_RT    the axes of the trunk, in which the parts are given, in the
///                axes of the root link.
/// @param shapes  of the root link.
inline std::string UrdfOf(
    const std::vector<Part>& parts,
    const Eigen::Matrix3d& R_RT = Eigen::Matrix3d::Identity(),
    const Eigen::Vector3d& trunk_com = {0, 0, 0.2},
    const std::string& shapes = "") {
  std::string text = "<robot name='generated'><link name='trunk'>" +
                     InertialOf(10, R_RT * trunk_com) + shapes + "</link>";
  for (const Part& part : parts) {
    const bool at_root = part.parent == "trunk";
    const Eigen::Matrix3d R =
        at_root ? R_RT : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    text += "<link name='" + part.link + "'>" +
            (part.mass > 0 ? InertialOf(part.mass, {0, 0, 0}) : "") +
            part.shapes + "</link><joint name='" + part.link +
            "_joint' type='revolute'><origin xyz='" + Numbers(R * part.xyz) +
            "' rpy='" + Numbers(RpyFromMatrix(R)) + "'/><parent link='" +
            part.parent + "'/><child link='" + part.link + "'/><axis xyz='" +
            Numbers(part.axis) + "'/><limit lower='" +
            std::to_string(part.lower) + "' upper='" +
            std::to_string(part.upper) + "' effort='" +
            std::to_string(part.effort) + "' velocity='9'/></joint>";
  }
  return text + "</robot>";
}

/// A leg of six joints, straight at rest. With `words` its links are called
/// thigh, shank, ..., else a, b, ... The foot is the last part.
struct LegSpec {
  std::string prefix;
  Eigen::Vector3d hip;
  double length = 0.8;    ///< m.
  std::string foot = "";  ///< Shapes of the foot.
  bool words = false;
  std::string parent = "trunk";
};

inline std::vector<Part> MakeLeg(const LegSpec& spec) {
  const Eigen::Vector3d o = Eigen::Vector3d::Zero();
  const Eigen::Vector3d down(0, 0, -0.5 * spec.length);
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::string p = spec.prefix;
  const auto name = [&](const char* word, const char* plain) {
    return p + (spec.words ? word : plain);
  };
  const std::string hip_1 = name("hip_1", "a"), hip_2 = name("hip_2", "b");
  const std::string thigh = name("thigh", "c"), shank = name("shank", "d");
  const std::string ankle = name("ankle", "e"), foot = name("foot", "f");
  return {{hip_1, spec.parent, spec.hip, z},
          {hip_2, hip_1, o, x},
          {thigh, hip_2, o, y},
          {shank, thigh, down, y},
          {ankle, shank, down, y},
          {foot, ankle, o, x, 1, spec.foot}};
}

/// An arm of three joints that hangs down at rest.
inline std::vector<Part> MakeArm(const LegSpec& spec) {
  const Eigen::Vector3d down(0, 0, -0.5 * spec.length);
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0);
  const std::string p = spec.prefix;
  const auto name = [&](const char* word, const char* plain) {
    return p + (spec.words ? word : plain);
  };
  const std::string shoulder = name("shoulder", "u");
  const std::string elbow = name("elbow", "v"), hand = name("hand", "w");
  return {{shoulder, spec.parent, spec.hip, y},
          {elbow, shoulder, down, y},
          {hand, elbow, down, x, 0.5, spec.foot}};
}

inline std::vector<Part> Joined(const std::vector<std::vector<Part>>& groups) {
  std::vector<Part> all;
  for (const auto& group : groups) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

}  // namespace poise
