// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <sstream>
#include <string>

namespace poise {

/// Parameters of a biped with legs of six joints, box feet and two arms of one
/// joint. It has 14 joints, so that simulations of it are fast.
struct SmallBiped {
  double leg_effort = 100;     ///< N m.
  double arm_effort = 10;      ///< N m.
  double arm_tilt = 0;         ///< Angle of the arms in front of vertical, rad.
  double scale = 1;            ///< Scales lengths. Masses scale by its cube.
  double yaw = 0;              ///< Turns the root link's axes, rad.
  std::string left = "left_";  ///< Prefix of names on the left.
  std::string right = "right_";  ///< Prefix of names on the right.
  bool has_shapes = true;        ///< Whether the feet have shapes.
};

/// Writes the URDF of a biped.
class SmallBipedWriter {
 public:
  explicit SmallBipedWriter(const SmallBiped& from) : from_(from) {
    text_ << "<robot name='small'>";
    AddLink("trunk", 10, {0, 0, 0.2}, "");
    for (const int side : {1, -1}) {
      const std::string p = side > 0 ? from.left : from.right;
      const double foot_y = 0.1 * side;
      const Eigen::Vector3d o(0, 0, 0);
      AddJoint("trunk", p + "hip_yaw", {0, foot_y, 0}, "0 0 1");
      AddJoint(p + "hip_yaw", p + "hip_roll", o, "1 0 0");
      AddJoint(p + "hip_roll", p + "thigh", o, "0 1 0");
      AddJoint(p + "thigh", p + "knee", {0, 0, -0.3}, "0 1 0");
      AddJoint(p + "knee", p + "ankle", {0, 0, -0.3}, "0 1 0");
      AddJoint(p + "ankle", p + "foot", o, "1 0 0",
               "<collision><origin xyz='" + Print({0.03, 0, -0.04}) +
                   "'/><geometry><box size='" + Print({0.2, 0.1, 0.02}) +
                   "'/></geometry></collision>");
      AddArm(p, side);
    }
    text_ << "</robot>";
  }

  std::string text() const { return text_.str(); }

 private:
  std::string Print(const Eigen::Vector3d& p) const {
    std::ostringstream text;
    text.precision(17);
    text << from_.scale * p.x() << " " << from_.scale * p.y() << " "
         << from_.scale * p.z();
    return text.str();
  }

  void AddLink(const std::string& name, double mass, const Eigen::Vector3d& G,
               const std::string& shape) {
    const double m = mass * std::pow(from_.scale, 3);
    const double I = 0.0025 * m * from_.scale * from_.scale;
    text_ << "<link name='" << name << "'><inertial><origin xyz='" << Print(G)
          << "'/><mass value='" << m << "'/><inertia ixx='" << I
          << "' ixy='0' ixz='0' iyy='" << I << "' iyz='0' izz='" << I
          << "'/></inertial>" << (from_.has_shapes ? shape : "") << "</link>";
  }

  // The joint has the name of its child. Joints on the trunk turn the axes of
  // the root link back.
  void AddJoint(const std::string& parent, const std::string& child,
                const Eigen::Vector3d& at, const std::string& axis,
                const std::string& shape = "", double pitch = 0) {
    const bool at_root = parent == "trunk";
    const double yaw = at_root ? from_.yaw : 0;
    const Eigen::Vector3d p(std::cos(yaw) * at.x() - std::sin(yaw) * at.y(),
                            std::sin(yaw) * at.x() + std::cos(yaw) * at.y(),
                            at.z());
    const bool is_arm = child.find("arm") != std::string::npos;
    AddLink(child, 1, {0, 0, is_arm ? -0.15 : 0}, shape);
    text_ << "<joint name='" << child << "' type='revolute'><origin xyz='"
          << Print(p) << "' rpy='0 " << pitch << " " << yaw
          << "'/><parent link='" << parent << "'/><child link='" << child
          << "'/><axis xyz='" << axis
          << "'/><limit lower='-2' upper='2' effort='"
          << (is_arm ? from_.arm_effort : from_.leg_effort) *
                 std::pow(from_.scale, 4)
          << "' velocity='10'/></joint>";
  }

  void AddArm(const std::string& p, int side) {
    AddJoint("trunk", p + "arm", {0, 0.25 * side, 0.4}, "0 1 0", "",
             -from_.arm_tilt);
  }

  SmallBiped from_;
  std::ostringstream text_;
};

/// Returns the URDF of a biped.
inline std::string TextOf(const SmallBiped& from) {
  return SmallBipedWriter(from).text();
}

}  // namespace poise
