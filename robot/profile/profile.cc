// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/profile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "poise/math/rpy.h"
#include "poise/robot/feet/feet.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/limits.h"
#include "poise/robot/profile/massless.h"
#include "poise/robot/profile/sides.h"
#include "poise/robot/profile/yaml_file.h"
#include "poise/robot/standing.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

using Path = std::filesystem::path;

// Reads values of a file. Throws Refusal with the line of an invalid value.
struct Reader {
  const std::string file;

  [[noreturn]] void Refuse(const YAML::Node& at,
                           const std::string& what) const {
    poise::Refuse(file, at, what);
  }

  // Throws Refusal about a value, with the description of valid values.
  [[noreturn]] void Refuse(const YAML::Node& value, const std::string& thing,
                           const std::string& wanted) const {
    Refuse(value, thing + " is " + Shown(value) + ", must be " + wanted);
  }

  double Number(const YAML::Node& node, const std::string& thing) const {
    const auto value = ToNumber(node);
    if (!value) Refuse(node, thing, "a finite number");
    constexpr double kLargest = 1e6;  // m or rad.
    if (std::abs(*value) > kLargest)
      Refuse(node, thing, "between -1e6 and 1e6");
    return *value;
  }

  std::string Text(const YAML::Node& node, const std::string& thing) const {
    if (!node.IsScalar() || node.Scalar().empty()) {
      Refuse(node, thing, "a name");
    }
    return node.Scalar();
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> Numbers(const YAML::Node& node,
                                          const std::string& thing) const {
    if (!node.IsSequence() || node.size() != kSize) {
      Refuse(node, thing, std::to_string(kSize) + " numbers");
    }
    Eigen::Matrix<double, kSize, 1> values;
    for (int i = 0; i < kSize; ++i) values[i] = Number(node[i], thing);
    return values;
  }

  void ExpectMap(const YAML::Node& node, const std::string& thing,
                 const std::set<std::string>& keys) const;

  // Reads roll, pitch and yaw, in rad.
  Eigen::Vector3d Angles(const YAML::Node& node,
                         const std::string& thing) const;

  std::map<std::string, JointValue> Joints(const YAML::Node& node,
                                           const std::string& thing) const;

  // Refuses a point with a coordinate above 1 m, because no sole is as large.
  // The file is then likely in another unit.
  void ExpectSmall(const Eigen::Vector2d& point, const YAML::Node& at,
                   const std::string& thing) const {
    if (point.cwiseAbs().maxCoeff() <= 1) return;
    Refuse(at,
           thing + " reaches over 1 m from the center, must be at most 1 m");
  }

  // Returns the sole's axes in the link. The z axis is along the normal. The x
  // axis is near the link's x axis. If the normal is within 26 degrees of the
  // link's x axis, the x axis is near the link's z axis instead.
  Eigen::Matrix3d FromNormal(const YAML::Node& node,
                             const std::string& thing) const;

  SoleProfile Sole(const std::string& name, const YAML::Node& node) const;
};

void Reader::ExpectMap(const YAML::Node& node, const std::string& thing,
                       const std::set<std::string>& keys) const {
  if (!node.IsMap()) Refuse(node, thing, "a map");
  for (const auto& item : node) {
    if (keys.empty() || keys.count(item.first.Scalar()) != 0) continue;
    std::string known;
    for (const std::string& key : keys) known += " " + key;
    Refuse(item.first, thing + ": unknown key " + Shown(item.first) +
                           ", must be one of" + known);
  }
}

Eigen::Vector3d Reader::Angles(const YAML::Node& node,
                               const std::string& thing) const {
  const Eigen::Vector3d rpy = Numbers<3>(node, thing);
  constexpr double kTurn = 6.3;
  if (rpy.cwiseAbs().maxCoeff() > kTurn) {
    Refuse(node, thing +
                     " is more than one turn, must be in rad: is it in "
                     "degrees?");
  }
  return rpy;
}

std::map<std::string, JointValue> Reader::Joints(
    const YAML::Node& node, const std::string& thing) const {
  ExpectMap(node, thing, {});
  std::map<std::string, JointValue> values;
  for (const auto& item : node) {
    const std::string& name = item.first.Scalar();
    values[name] = {Number(item.second, thing + ": " + Quoted(name)),
                    item.first.Mark().line + 1};
  }
  return values;
}

Eigen::Matrix3d Reader::FromNormal(const YAML::Node& node,
                                   const std::string& thing) const {
  const Eigen::Vector3d normal = Numbers<3>(node, thing);
  if (!(normal.norm() > 1e-6))
    Refuse(node, thing + " is zero, must be a direction");
  const Eigen::Vector3d z = normal.normalized();
  constexpr double kAlong = 0.9;
  const Eigen::Vector3d forward = std::abs(z.x()) < kAlong
                                      ? Eigen::Vector3d::UnitX()
                                      : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d R;
  R.col(2) = z;
  R.col(1) = z.cross(forward).normalized();
  R.col(0) = R.col(1).cross(z);
  return R;
}

SoleProfile Reader::Sole(const std::string& name,
                         const YAML::Node& node) const {
  const std::string thing = "feet." + name;
  ExpectMap(node, thing, {"frame", "normal", "polygon", "rpy", "size", "xyz"});
  SoleProfile sole{name, "", {}, {}, node.Mark().line + 1};
  if (!node["frame"])
    Refuse(node, thing + ": has no frame, must have the name of a link");
  sole.frame = Text(node["frame"], thing + ".frame");
  if (node["xyz"]) sole.X_FS.p = Numbers<3>(node["xyz"], thing + ".xyz");
  if (node["rpy"]) {
    sole.X_FS.R = MatrixFromRpy(Angles(node["rpy"], thing + ".rpy"));
  }
  if (const YAML::Node normal = node["normal"]) {
    if (node["rpy"])
      Refuse(node, thing + ": has rpy and normal, must have one of them");
    sole.X_FS.R = FromNormal(normal, thing + ".normal");
  }
  if (node["size"].IsDefined() == node["polygon"].IsDefined()) {
    Refuse(node, thing + ": must have one of size and polygon");
  }
  if (const YAML::Node size = node["size"]) {
    const Eigen::Vector2d half = 0.5 * Numbers<2>(size, thing + ".size");
    ExpectSmall(half, size, thing + ".size");
    if (!(half.minCoeff() > 0)) {
      Refuse(size, thing + ".size is [" + PrintNumber(2 * half.x()) + ", " +
                       PrintNumber(2 * half.y()) + "], must be positive");
    }
    for (const double x : {-1, 1}) {
      for (const double y : {-1, 1}) {
        sole.sole_S.emplace_back(x * half.x(), y * half.y());
      }
    }
  } else {
    if (!node["polygon"].IsSequence()) {
      Refuse(node["polygon"], thing + ".polygon", "a list of corners");
    }
    for (const YAML::Node& corner : node["polygon"]) {
      sole.sole_S.push_back(Numbers<2>(corner, thing + ".polygon"));
      ExpectSmall(sole.sole_S.back(), corner, thing + ".polygon");
    }
    if (!IsConvex(sole.sole_S)) {
      Refuse(node["polygon"], thing +
                                  ".polygon is not convex, must be convex "
                                  "with its corners in order");
    }
  }
  return sole;
}

void ReadPosture(const Reader& reader, const YAML::Node& node,
                 Profile* profile) {
  reader.ExpectMap(node, "posture", {"base", "found", "joints"});
  if (const YAML::Node base = node["base"]) {
    reader.ExpectMap(base, "posture.base", {"rpy", "xyz"});
    if (!base["xyz"])
      reader.Refuse(base, "posture.base: has no xyz, must have xyz");
    profile->base_line = node["base"].Mark().line + 1;
    profile->base_xyz = reader.Numbers<3>(base["xyz"], "posture.base.xyz");
    if (base["rpy"]) {
      profile->base_rpy = reader.Angles(base["rpy"], "posture.base.rpy");
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
  reader.Refuse(node, "mimic", "free, coupled or locked");
}

// Reads the keys `forward`, `left` and `right`.
void ReadSides(const Reader& reader, const YAML::Node& root, Sides* sides) {
  const auto read = [&](const char* name, TextValue* value) {
    const YAML::Node node = root[name];
    if (!node) return;
    *value = {reader.Text(node, name), node.Mark().line + 1};
  };
  read("left", &sides->left);
  read("right", &sides->right);
  if (const YAML::Node node = root["forward"]) {
    if (!node.IsScalar() || !AxisOfName(node.Scalar())) {
      reader.Refuse(node, "forward", "one of +x -x +y -y +z -z");
    }
    read("forward", &sides->forward);
  }
  for (const auto& [name, other] :
       {std::make_pair("left", "right"), std::make_pair("right", "left")}) {
    if (root[name] && !root[other]) {
      reader.Refuse(root[name], std::string(name) + ": there is no " + other +
                                    ", must be given together");
    }
  }
}

// Makes the feet that a profile describes.
std::vector<Foot> MakeFeet(const RobotModel& model, const Profile& profile) {
  std::vector<Foot> feet;
  for (const SoleProfile& sole : profile.feet) {
    const auto refuse = [&](const std::string& what) {
      throw Refusal(profile.file.string(), sole.line,
                    "feet." + sole.name + what);
    };
    const std::optional<int> frame = model.tree.FindFrame(sole.frame);
    if (!frame) refuse(": the robot has no link " + Quoted(sole.frame));
    auto foot = MakeFoot(model, sole.name, *frame, sole.X_FS, sole.sole_S);
    if (!foot) refuse(": its sole is under 1 mm wide or long, must be larger");
    feet.push_back(*std::move(foot));
    if (feet.front().body == feet.back().body && feet.size() > 1) {
      refuse(": is on the same body as left_foot, must be on another");
    }
  }
  return feet;
}

// Sets each mimic joint to the value that follows from its source, except the
// joints that the profile gives.
void Couple(const std::map<std::string, JointValue>& given, Robot* robot) {
  const Tree& tree = robot->model.tree;
  // A source may be a mimic joint too, so one pass may not be enough. The URDF
  // loader rejects cycles.
  for (size_t i = 0; i < robot->model.mimics.size(); ++i) {
    bool changed = false;
    for (const MimicCoupling& mimic : robot->model.mimics) {
      if (given.count(tree.joints()[mimic.joint].name) != 0) continue;
      double& q = robot->q_nominal[tree.q_start() + mimic.joint];
      const double source = robot->q_nominal[tree.q_start() + mimic.source];
      const double led = mimic.multiplier * source + mimic.offset;
      changed |= q != led;
      q = led;
    }
    if (!changed) return;
  }
}

// Returns the joints to lock, as LockedJoints() describes, if `moved` says
// which joints move no mass.
std::map<std::string, JointValue> Lock(const RobotModel& model,
                                       const Profile& profile,
                                       const MovedMass& moved) {
  // A joint that moves less than this fraction of the robot's mass is no joint
  // of a leg: a foot weighs more. It may be locked with its source.
  constexpr double kFinger = 0.01;
  const Tree& tree = model.tree;
  const auto refuse = [&](const JointValue& joint, const std::string& what) {
    throw Refusal(profile.file.string(), joint.line, "locked: " + what);
  };
  std::vector<const MimicCoupling*> mimic_of(tree.num_joints());
  for (const MimicCoupling& mimic : model.mimics) {
    mimic_of[mimic.joint] = &mimic;
  }
  std::map<std::string, JointValue> locked;
  for (const auto& [name, joint] : profile.locked) {
    const std::optional<int> j = tree.FindJoint(name);
    if (!j) refuse(joint, "the robot has no moving joint " + Quoted(name));
    // The limits of a mimic joint are not checked, because its source
    // determines its value.
    if (!mimic_of[*j] && !IsWithin(model.limits[*j], joint.value)) {
      refuse(joint, SayOutside(name, model.limits[*j], joint.value));
    }
    locked[name] = joint;
  }
  const Eigen::VectorXd q_rest = RestConfiguration(model);
  // The joints that are locked because of their mass.
  std::set<std::string> unasked;
  // The value of a joint that is locked but not in `locked`.
  const auto wanted = [&](int j) {
    const auto given = profile.joints.find(tree.joints()[j].name);
    return given != profile.joints.end()
               ? given->second
               : JointValue{q_rest[tree.q_start() + j], 0};
  };
  for (int j = 0; j < tree.num_joints(); ++j) {
    if (!moved.none[j] || mimic_of[j]) continue;
    locked.emplace(tree.joints()[j].name, wanted(j));
    unasked.insert(tree.joints()[j].name);
  }
  for (const MimicCoupling& mimic : model.mimics) {
    const std::string& name = tree.joints()[mimic.joint].name;
    // The chain of sources ends at a joint that is locked or is not a mimic
    // joint. The URDF loader rejects cycles.
    std::vector<const MimicCoupling*> chain;
    int joint = mimic.joint;
    while (mimic_of[joint] != nullptr &&
           locked.count(tree.joints()[joint].name) == 0) {
      chain.push_back(mimic_of[joint]);
      joint = mimic_of[joint]->source;
    }
    if (chain.empty()) {
      if (profile.mimic != MimicPolicy::kCoupled) continue;
      const auto given = profile.locked.find(name);
      const std::string& source = tree.joints()[mimic.source].name;
      if (given == profile.locked.end() || locked.count(source) != 0) continue;
      refuse(given->second, Quoted(name) + " is coupled to " + Quoted(source) +
                                ": lock the source joint instead");
    }
    const std::string& source = tree.joints()[joint].name;
    const auto fixed = locked.find(source);
    // Joints of a leg do not follow a source that is locked for its mass.
    const bool is_fixed = fixed != locked.end();
    const bool by_mass = is_fixed && unasked.count(source) != 0;
    const bool is_light = moved.none[mimic.joint] ||
                          (by_mass && moved.fraction[mimic.joint] < kFinger);
    const bool follows =
        profile.mimic == MimicPolicy::kLocked ||
        (profile.mimic == MimicPolicy::kCoupled && is_fixed && !by_mass);
    if (!is_light && !follows) continue;
    if (!follows) unasked.insert(name);
    JointValue q = is_fixed ? fixed->second : wanted(joint);
    while (!chain.empty()) {
      q.value = chain.back()->multiplier * q.value + chain.back()->offset;
      chain.pop_back();
    }
    locked[name] = q;
  }
  return locked;
}

}  // namespace

Profile LoadProfile(const Path& file) {
  const Reader reader{file.string()};
  Profile profile;
  profile.file = file;
  const YAML::Node root = LoadYaml(file);
  reader.ExpectMap(root, "a profile",
                   {"feet", "forward", "left", "locked", "mimic", "posture",
                    "right", "tasks"});
  if (const YAML::Node feet = root["feet"]) {
    reader.ExpectMap(feet, "feet", {"left_foot", "right_foot"});
    for (const char* name : {"left_foot", "right_foot"}) {
      if (!feet[name]) reader.Refuse(feet, std::string("feet: has no ") + name);
      profile.feet.push_back(reader.Sole(name, feet[name]));
    }
  }
  ReadSides(reader, root, &profile.sides);
  if (root["locked"]) profile.locked = reader.Joints(root["locked"], "locked");
  if (root["mimic"]) profile.mimic = ReadMimic(reader, root["mimic"]);
  if (root["posture"]) ReadPosture(reader, root["posture"], &profile);
  if (const YAML::Node tasks = root["tasks"]) {
    reader.ExpectMap(tasks, "tasks", {});
    profile.tasks = tasks;
  }
  return profile;
}

std::map<std::string, JointValue> LockedJoints(const RobotModel& model,
                                               const Profile& profile) {
  return Lock(model, profile, FindMovedMass(model));
}

std::vector<std::string> JointsWithoutMass(const RobotModel& model,
                                           const Profile& profile) {
  MovedMass moved = FindMovedMass(model);
  const auto with = Lock(model, profile, moved);
  moved.none.assign(moved.none.size(), false);
  const auto without = Lock(model, profile, moved);
  std::vector<std::string> names;
  for (const Joint& joint : model.tree.joints()) {  // In the tree's order.
    if (with.count(joint.name) == without.count(joint.name)) continue;
    names.push_back(joint.name);
  }
  return names;
}

RobotModel MakeModel(const UrdfDocument& urdf, const Profile& profile) {
  RobotModel model = urdf.MakeModel();
  std::map<std::string, double> locked;
  for (const auto& [name, joint] : LockedJoints(model, profile)) {
    locked[name] = joint.value;
  }
  if (!locked.empty()) model = urdf.MakeModel(locked);
  const std::map<std::string, Inertia> small = MakeSmallInertias(model);
  if (!small.empty()) model = urdf.MakeModel(locked, small);
  if (profile.mimic != MimicPolicy::kCoupled) model.mimics.clear();
  return model;
}

Robot MakeRobot(const UrdfDocument& urdf, const Profile& profile,
                std::vector<Finding>* findings) {
  Robot robot{MakeModel(urdf, profile), {}, {}, false};
  const std::vector<std::string> massless =
      JointsWithoutMass(urdf.MakeModel(), profile);
  if (findings != nullptr) {
    if (auto warning = WarnOfMassless(massless)) findings->push_back(*warning);
  }
  const Tree& tree = robot.model.tree;
  robot.q_nominal = RestConfiguration(robot.model);
  for (const auto& [name, joint] : profile.joints) {
    const auto refuse = [&, line = joint.line](const std::string& what) {
      throw Refusal(profile.file.string(), line, "posture.joints: " + what);
    };
    const std::optional<int> j = tree.FindJoint(name);
    // The value was used to lock the joint.
    if (std::find(massless.begin(), massless.end(), name) != massless.end()) {
      continue;
    }
    if (!j && LockedJoints(urdf.MakeModel(), profile).count(name) != 0) {
      refuse(Quoted(name) + " is locked, must not be in the posture");
    }
    if (!j) refuse("the robot has no moving joint " + Quoted(name));
    const JointLimits& limits = robot.model.limits[*j];
    if (!IsWithin(limits, joint.value)) {
      refuse(SayOutside(name, limits, joint.value));
    }
    robot.q_nominal[tree.q_start() + *j] = joint.value;
  }
  Couple(profile.joints, &robot);
  const std::string file = profile.file.string();
  robot.feet = profile.feet.empty()
                   ? FindFeetOf(robot.model, profile.sides, file, findings)
                   : MakeFeet(robot.model, profile);
  if (!profile.feet.empty()) {
    const std::string reason = WhyNoPairOfFeet(robot);
    if (!reason.empty()) {
      throw Refusal(file, profile.feet[0].line, "feet: " + reason);
    }
  }
  CheckSides(robot, profile.sides, file, !profile.feet.empty());
  if (!profile.base_xyz) return robot;

  robot.can_stand = true;
  robot.q_nominal.head<3>() = *profile.base_xyz;
  const Eigen::Quaterniond orientation(MatrixFromRpy(profile.base_rpy));
  robot.q_nominal.segment<4>(3) = orientation.coeffs();
  const std::string reason = WhyNotStanding(robot);
  if (reason.empty()) return robot;
  throw Refusal(profile.file.string(), profile.base_line, "posture: " + reason);
}

Robot LoadRobot(const Path& urdf, const Profile& profile,
                std::vector<Finding>* findings) {
  return MakeRobot(UrdfDocument(urdf, findings), profile, findings);
}

}  // namespace poise
