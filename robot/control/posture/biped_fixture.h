// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>

namespace poise {

/// Parameters of a biped with legs of six joints, a waist of three, a neck, and
/// arms of seven joints with fingers.
struct ArmsCase {
  double shoulder = 0.25;  ///< Distance of a shoulder from the middle, m.
  double hip = 0.1;        ///< Distance of a hip from the middle, m.
  int fingers = 0;         ///< Fingers of each hand.
  int phalanges = 0;       ///< Joints of each finger.
};

/// Writes the URDF of a biped.
class BipedWriter {
 public:
  explicit BipedWriter(const ArmsCase& from) {
    AddLink("pelvis", 10, Cylinder(0.06, 0.1, 0));
    for (const int side : {1, -1}) AddLeg(side, from.hip);
    std::string parent = "pelvis";
    const char* axes[] = {"0 0 1", "1 0 0", "0 1 0"};
    for (int i = 0; i < 3; ++i) {
      const std::string name = "waist" + std::to_string(i);
      AddLink(name, i < 2 ? 2 : 15, i < 2 ? "" : Cylinder(0.1, 0.3, 0.25), 0.2);
      AddJoint(parent, name, {0, 0, 0.05}, axes[i], -1, 1);
      parent = name;
    }
    AddLink("head", 3, "");
    AddJoint(parent, "head", {0, 0, 0.5}, "0 0 1", -1, 1);
    for (const int side : {1, -1}) AddArm(side, from, parent);
  }

  std::string text() const {
    return "<robot name='biped'>" + text_ + "</robot>";
  }

 private:
  static std::string Cylinder(double radius, double length, double z) {
    return "<collision><origin xyz='0 0 " + std::to_string(z) +
           "'/><geometry><cylinder radius='" + std::to_string(radius) +
           "' length='" + std::to_string(length) + "'/></geometry></collision>";
  }

  void AddLink(const std::string& name, double mass, const std::string& shape,
               double z = 0) {
    const std::string I = std::to_string(mass * 0.0025);
    text_ += "<link name='" + name + "'><inertial><origin xyz='0 0 " +
             std::to_string(z) + "'/><mass value='" + std::to_string(mass) +
             "'/><inertia ixx='" + I + "' ixy='0' ixz='0' iyy='" + I +
             "' iyz='0' izz='" + I + "'/></inertial>" + shape + "</link>";
  }

  // The joint has the name of its child.
  void AddJoint(const std::string& parent, const std::string& child,
                const Eigen::Vector3d& at, const std::string& axis,
                double lower = -2, double upper = 2) {
    text_ += "<joint name='" + child + "' type='revolute'><origin xyz='";
    for (const double x : {at.x(), at.y(), at.z()}) {
      text_ += std::to_string(x) + " ";
    }
    text_ += "'/><parent link='" + parent + "'/><child link='" + child +
             "'/><axis xyz='" + axis + "'/><limit lower='" +
             std::to_string(lower) + "' upper='" + std::to_string(upper) +
             "' effort='200' velocity='10'/></joint>";
  }

  void AddLeg(int side, double hip) {
    const std::string s = side > 0 ? "l_" : "r_";
    AddLink(s + "hip_yaw", 1, "");
    AddJoint("pelvis", s + "hip_yaw", {0, side * hip, 0}, "0 0 1");
    AddLink(s + "hip_roll", 1, "");
    AddJoint(s + "hip_yaw", s + "hip_roll", {0, 0, 0}, "1 0 0");
    AddLink(s + "hip_pitch", 5, Cylinder(0.05, 0.3, -0.2), -0.2);
    AddJoint(s + "hip_roll", s + "hip_pitch", {0, 0, 0}, "0 1 0");
    AddLink(s + "knee", 3, Cylinder(0.04, 0.3, -0.2), -0.2);
    AddJoint(s + "hip_pitch", s + "knee", {0, 0, -0.4}, "0 1 0", 0, 2.3);
    AddLink(s + "ankle_pitch", 1, "");
    AddJoint(s + "knee", s + "ankle_pitch", {0, 0, -0.4}, "0 1 0");
    AddLink(s + "ankle_roll", 1.2,
            "<collision><origin xyz='0.03 0 -0.07'/><geometry><box "
            "size='0.2 0.09 0.02'/></geometry></collision>");
    AddJoint(s + "ankle_pitch", s + "ankle_roll", {0, 0, 0}, "1 0 0");
  }

  void AddArm(int side, const ArmsCase& from, std::string parent) {
    const std::string s = side > 0 ? "l_" : "r_";
    const char* axes[] = {"0 1 0", "1 0 0", "0 0 1", "0 1 0",
                          "0 0 1", "1 0 0", "0 1 0"};
    for (int i = 0; i < 7; ++i) {
      const std::string name = s + "arm" + std::to_string(i);
      const bool is_long = i == 2 || i == 4;
      AddLink(name, 0.8, is_long ? Cylinder(0.04, 0.25, -0.165) : "", -0.1);
      const double y = i == 0 ? side * from.shoulder : 0;
      const double z = i == 0 ? 0.4 : i == 3 || i == 5 ? -0.33 : 0;
      AddJoint(parent, name, {0, y, z}, axes[i], i == 3 ? -2.3 : -2,
               i == 3 ? 0 : 2);
      parent = name;
    }
    for (int f = 0; f < from.fingers; ++f) {
      std::string last = parent;
      for (int i = 0; i < from.phalanges; ++i) {
        const std::string name =
            s + "finger" + std::to_string(f) + "_" + std::to_string(i);
        AddLink(name, 0.01, "", -0.01);
        AddJoint(last, name, {0, i == 0 ? 0.02 * f : 0, i == 0 ? -0.05 : -0.03},
                 "0 1 0", 0, 1.5);
        last = name;
      }
    }
  }

  std::string text_;
};

/// Returns the URDF of a biped.
inline std::string BipedText(const ArmsCase& from) {
  return BipedWriter(from).text();
}

}  // namespace poise
