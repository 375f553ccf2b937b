// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/added_fingers.h"

#include <fstream>
#include <sstream>
#include <string>

namespace poise {
namespace {

constexpr int kJointsOfAFinger = 5;

// Returns the elements of one joint of a finger.
std::string MakeJoint(const std::string& parent, const std::string& name,
                      double x) {
  std::ostringstream out;
  out << "<joint name='" << name << "' type='revolute'><parent link='" << parent
      << "'/><child link='" << name << "'/><origin xyz='" << x
      << " 0 -0.028'/><axis xyz='1 0 0'/><limit lower='-1.5' upper='1.5' "
         "effort='0.6' velocity='10'/></joint><link name='"
      << name
      << "'><inertial><origin xyz='0 0 -0.014'/><mass value='0.004'/>"
         "<inertia ixx='3.5625e-07' ixy='0' ixz='0' iyy='3.5625e-07' iyz='0' "
         "izz='1.125e-07'/></inertial></link>";
  return out.str();
}

}  // namespace

UrdfDocument AddFingers(int count) {
  std::stringstream urdf;
  urdf << std::ifstream("robot/models/humanoid.urdf").rdbuf();
  std::string text = urdf.str(), added;
  for (const std::string side : {"l", "r"}) {
    for (int finger = 0; finger < count; ++finger) {
      std::string parent = side + "_hand";
      for (int joint = 0; joint < kJointsOfAFinger; ++joint) {
        const std::string name = side + "_added_" + std::to_string(finger) +
                                 "_" + std::to_string(joint);
        added += MakeJoint(parent, name, joint == 0 ? 0.01 * (finger - 3) : 0);
        parent = name;
      }
    }
  }
  text.insert(text.rfind("</robot>"), added);
  return UrdfDocument(text, "humanoid with more fingers");
}

}  // namespace poise
