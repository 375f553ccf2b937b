// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/profile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "robot/feet.h"
#include "robot/find_feet.h"
#include "robot/rpy.h"
#include "robot/urdf.h"

namespace poise {
namespace {

using Path = std::filesystem::path;

// In one line, whatever a key or a scalar of the file holds.
[[noreturn]] void Refuse(const Path& file, int line, std::string what) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  std::replace_if(what.begin(), what.end(), is_control, ' ');
  throw std::invalid_argument(file.string() + ":" + std::to_string(line) +
                              ": " + what);
}

// A file being read, so that every complaint has its line.
struct Reader {
  const Path& file;

  [[noreturn]] void Refuse(const YAML::Node& at,
                           const std::string& what) const {
    poise::Refuse(file, at.Mark().line + 1, what);
  }

  double Number(const YAML::Node& node, const std::string& thing) const {
    double value = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) ||
        !std::isfinite(value)) {
      Refuse(node, thing + " must be a finite number");
    }
    return value;
  }

  std::string Text(const YAML::Node& node, const std::string& thing) const {
    if (!node.IsScalar() || node.Scalar().empty()) {
      Refuse(node, thing + " must be a name");
    }
    return node.Scalar();
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> Numbers(const YAML::Node& node,
                                          const std::string& thing) const {
    if (!node.IsSequence() || node.size() != kSize) {
      Refuse(node, thing + " must be " + std::to_string(kSize) + " numbers");
    }
    Eigen::Matrix<double, kSize, 1> values;
    for (int i = 0; i < kSize; ++i) values[i] = Number(node[i], thing);
    return values;
  }

  void ExpectMap(const YAML::Node& node, const std::string& thing,
                 const std::set<std::string>& keys) const {
    if (!node.IsMap()) Refuse(node, thing + " must be a map");
    for (const auto& item : node) {
      if (keys.empty() || keys.count(Text(item.first, thing)) != 0) continue;
      std::string known;
      for (const std::string& key : keys) known += " " + key;
      Refuse(item.first, thing + ": unknown key '" + item.first.Scalar() +
                             "', must be one of" + known);
    }
  }

  std::map<std::string, JointValue> Joints(const YAML::Node& node,
                                           const std::string& thing) const {
    ExpectMap(node, thing, {});
    std::map<std::string, JointValue> values;
    for (const auto& item : node) {
      const std::string name = Text(item.first, thing);
      const JointValue value{Number(item.second, thing + "." + name),
                             item.first.Mark().line + 1};
      if (!values.emplace(name, value).second) {
        Refuse(item.first, thing + "." + name + " is there twice");
      }
    }
    return values;
  }

  SoleProfile Sole(const std::string& name, const YAML::Node& node) const {
    const std::string thing = "feet." + name;
    ExpectMap(node, thing, {"frame", "polygon", "rpy", "size", "xyz"});
    SoleProfile sole{name, "", {}, {}, node.Mark().line + 1};
    if (!node["frame"]) Refuse(node, thing + ": must have a frame, a link");
    sole.frame = Text(node["frame"], thing + ".frame");
    if (node["xyz"]) sole.X_FS.p = Numbers<3>(node["xyz"], thing + ".xyz");
    if (node["rpy"]) {
      sole.X_FS.R = RotationFromRpy(Numbers<3>(node["rpy"], thing + ".rpy"));
    }
    if (node["size"].IsDefined() == node["polygon"].IsDefined()) {
      Refuse(node, thing + ": must have either size or polygon");
    }
    if (node["size"]) {
      const Eigen::Vector2d half =
          0.5 * Numbers<2>(node["size"], thing + ".size");
      if (!(half.minCoeff() > 0)) {
        Refuse(node["size"], thing + ".size must be positive");
      }
      for (const double x : {-1, 1}) {
        for (const double y : {-1, 1}) {
          sole.sole_S.emplace_back(x * half.x(), y * half.y());
        }
      }
    } else {
      if (!node["polygon"].IsSequence()) {
        Refuse(node["polygon"], thing + ".polygon must be a list of corners");
      }
      for (const YAML::Node& corner : node["polygon"]) {
        sole.sole_S.push_back(Numbers<2>(corner, thing + ".polygon"));
      }
    }
    return sole;
  }
};

void ReadPosture(const Reader& reader, const YAML::Node& node,
                 Profile* profile) {
  reader.ExpectMap(node, "posture", {"base", "found", "joints"});
  if (const YAML::Node base = node["base"]) {
    reader.ExpectMap(base, "posture.base", {"rpy", "xyz"});
    if (!base["xyz"]) reader.Refuse(base, "posture.base: must have xyz");
    profile->base_xyz = reader.Numbers<3>(base["xyz"], "posture.base.xyz");
    if (base["rpy"]) {
      profile->base_rpy = reader.Numbers<3>(base["rpy"], "posture.base.rpy");
    }
  }
  if (node["found"]) {
    profile->posture_found = reader.Text(node["found"], "posture.found");
  }
  if (node["joints"]) {
    profile->joints = reader.Joints(node["joints"], "posture.joints");
  }
}

MimicPolicy ReadMimic(const Reader& reader, const YAML::Node& node) {
  const std::string text = reader.Text(node, "mimic");
  if (text == "free") return MimicPolicy::kFree;
  if (text == "coupled") return MimicPolicy::kCoupled;
  if (text == "locked") return MimicPolicy::kLocked;
  reader.Refuse(node,
                "mimic is '" + text + "', must be free, coupled or locked");
}

// The nearest value to 0 inside the limits, or q = 0 where there is none.
double Rest(const JointLimits& limits) {
  return std::max(limits.lower, std::min(0.0, limits.upper));
}

// The joints to lock, mimics included where the profile says so.
std::map<std::string, double> LockedJoints(const Path& urdf,
                                           const Profile& profile) {
  std::map<std::string, double> locked;
  for (const auto& [name, joint] : profile.locked) locked[name] = joint.value;
  if (profile.mimic != MimicPolicy::kLocked) return locked;
  const RobotModel model = LoadUrdf(urdf);
  for (const MimicCoupling& mimic : model.mimics) {
    const std::string& source = model.tree.joints()[mimic.source].name;
    const auto given = profile.joints.find(source);
    const double q = given != profile.joints.end()
                         ? given->second.value
                         : Rest(model.limits[mimic.source]);
    locked.emplace(model.tree.joints()[mimic.joint].name,
                   mimic.multiplier * q + mimic.offset);
  }
  return locked;
}

}  // namespace

Profile LoadProfile(const Path& file) {
  const Reader reader{file};
  Profile profile;
  profile.file = file;
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument(file.string() + ": cannot be read");
  } catch (const YAML::Exception& error) {
    Refuse(file, error.mark.line + 1, error.msg);
  }
  reader.ExpectMap(root, "a profile",
                   {"feet", "locked", "mimic", "posture", "tasks"});
  if (const YAML::Node feet = root["feet"]) {
    reader.ExpectMap(feet, "feet", {"left_foot", "right_foot"});
    for (const char* name : {"left_foot", "right_foot"}) {
      if (!feet[name]) reader.Refuse(feet, std::string("feet: no ") + name);
      profile.feet.push_back(reader.Sole(name, feet[name]));
    }
  }
  if (root["locked"]) profile.locked = reader.Joints(root["locked"], "locked");
  if (root["mimic"]) profile.mimic = ReadMimic(reader, root["mimic"]);
  if (root["posture"]) ReadPosture(reader, root["posture"], &profile);
  profile.tasks = root["tasks"];
  return profile;
}

Robot LoadRobot(const Path& urdf, const Profile& profile,
                std::vector<Finding>* findings) {
  Robot robot{
      LoadUrdf(urdf, LockedJoints(urdf, profile), findings), {}, {}, false};
  const Tree& tree = robot.model.tree;
  if (profile.mimic != MimicPolicy::kCoupled) robot.model.mimics.clear();

  for (const SoleProfile& sole : profile.feet) {
    const std::optional<int> frame = tree.FindFrame(sole.frame);
    if (!frame) {
      Refuse(
          profile.file, sole.line,
          "feet." + sole.name + ": the robot has no link '" + sole.frame + "'");
    }
    robot.feet.push_back(
        MakeFoot(robot.model, sole.name, *frame, sole.X_FS, sole.sole_S));
  }
  if (robot.feet.empty()) robot.feet = FindFeet(robot.model, findings);

  robot.can_stand = profile.base_xyz.has_value();
  robot.q_nominal = tree.MakeNeutral();
  robot.q_nominal.head<3>() =
      profile.base_xyz.value_or(Eigen::Vector3d::Zero());
  const Eigen::Quaterniond orientation(RotationFromRpy(profile.base_rpy));
  robot.q_nominal.segment<4>(3) = orientation.coeffs();
  for (int j = 0; j < tree.num_joints(); ++j) {
    robot.q_nominal[tree.q_start() + j] = Rest(robot.model.limits[j]);
  }
  for (const auto& [name, joint] : profile.joints) {
    const std::optional<int> j = tree.FindJoint(name);
    if (!j) {
      Refuse(profile.file, joint.line,
             "posture.joints: the robot has no moving joint '" + name + "'");
    }
    robot.q_nominal[tree.q_start() + *j] = joint.value;
  }
  return robot;
}

}  // namespace poise
