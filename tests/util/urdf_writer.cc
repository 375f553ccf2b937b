// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/urdf_writer.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

#include "poise/math/rpy.h"

namespace poise {
namespace {

std::string Print(double value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(std::numeric_limits<double>::max_digits10);
  stream << value;
  return stream.str();
}

std::string Print(const Eigen::Vector3d& v) {
  return Print(v.x()) + " " + Print(v.y()) + " " + Print(v.z());
}

// Returns name="value" with a space before it.
template <typename Value>
std::string Attribute(const std::string& name, const Value& value) {
  return " " + name + "=\"" + Print(value) + "\"";
}

std::string Named(const std::string& element, const std::string& attribute,
                  const std::string& value) {
  return "<" + element + " " + attribute + "=\"" + value + "\"";
}

std::string Origin(const Pose& X) {
  return "<origin" + Attribute("xyz", X.p) +
         Attribute("rpy", RpyFromMatrix(X.R)) + "/>";
}

std::string Inertial(const Inertia& M) {
  if (M.mass == 0) return "";
  Pose X_LG;
  X_LG.p = M.p_BoG_B;
  const Eigen::Matrix3d& I = M.I_G_B;
  return "<inertial>" + Origin(X_LG) + "<mass" + Attribute("value", M.mass) +
         "/><inertia" + Attribute("ixx", I(0, 0)) + Attribute("ixy", I(0, 1)) +
         Attribute("ixz", I(0, 2)) + Attribute("iyy", I(1, 1)) +
         Attribute("iyz", I(1, 2)) + Attribute("izz", I(2, 2)) +
         "/></inertial>";
}

std::string TypeName(JointType type) {
  switch (type) {
    case JointType::kFixed:
      return "fixed";
    case JointType::kRevolute:
      return "revolute";
    case JointType::kContinuous:
      return "continuous";
    case JointType::kPrismatic:
      return "prismatic";
  }
  return "";
}

std::string JointStart(const std::string& name, JointType type,
                       const std::string& parent, const std::string& child,
                       const Pose& X_PF) {
  return Named("joint", "name", name) + " type=\"" + TypeName(type) + "\">" +
         Named("parent", "link", parent) + "/>" +
         Named("child", "link", child) + "/>" + Origin(X_PF);
}

std::string Limits(const JointLimits& limits) {
  std::string text = "<limit";
  if (std::isfinite(limits.lower)) text += Attribute("lower", limits.lower);
  if (std::isfinite(limits.upper)) text += Attribute("upper", limits.upper);
  text += Attribute("effort", limits.effort) +
          Attribute("velocity", limits.velocity) + "/>";
  return text + "<dynamics" + Attribute("damping", limits.damping) +
         Attribute("friction", limits.friction) + "/>";
}

// Returns the index of the frame at a body's origin.
int OwnFrame(const Tree& tree, int body) {
  const auto& frames = tree.frames();
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    if (frames[i].body == body && frames[i].X_BF.R.isIdentity(0) &&
        frames[i].X_BF.p.isZero(0)) {
      return i;
    }
  }
  assert(false);
  return -1;
}

}  // namespace

std::string WriteUrdf(const RobotModel& model) {
  const Tree& tree = model.tree;
  std::vector<int> own(tree.num_bodies());
  for (int body = 0; body < tree.num_bodies(); ++body) {
    own[body] = OwnFrame(tree, body);
  }
  const auto link = [&](int body) { return tree.frames()[own[body]].name; };

  std::string text = Named("robot", "name", model.name) + ">\n";
  for (int body = 0; body < tree.num_bodies(); ++body) {
    text += Named("link", "name", link(body)) + ">" +
            Inertial(tree.inertias()[body]) + "</link>\n";
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    text += JointStart(joint.name, joint.type, link(joint.parent), link(j + 1),
                       joint.X_PF) +
            "<axis" + Attribute("xyz", joint.axis_F) + "/>" +
            Limits(model.limits[j]);
    for (const MimicCoupling& mimic : model.mimics) {
      if (mimic.joint != j) continue;
      text += Named("mimic", "joint", tree.joints()[mimic.source].name) +
              Attribute("multiplier", mimic.multiplier) +
              Attribute("offset", mimic.offset) + "/>";
    }
    text += "</joint>\n";
  }
  for (int i = 0; i < static_cast<int>(tree.frames().size()); ++i) {
    const Frame& frame = tree.frames()[i];
    if (own[frame.body] == i) continue;
    text += Named("link", "name", frame.name) + "/>\n" +
            JointStart(frame.name + "_fixed", JointType::kFixed,
                       link(frame.body), frame.name, frame.X_BF) +
            "</joint>\n";
  }
  return text + "</robot>\n";
}

}  // namespace poise
