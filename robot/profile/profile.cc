// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/profile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "poise/math/rpy.h"
#include "poise/robot/feet/feet.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/limits.h"
#include "poise/robot/profile/massless.h"
#include "poise/robot/profile/profile_reader.h"
#include "poise/robot/profile/side_defects.h"
#include "poise/robot/profile/sides.h"
#include "poise/robot/profile/yaml_file.h"
#include "poise/robot/standing.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {
namespace {

using Path = std::filesystem::path;

void ReadPosture(const ProfileReader& reader, const YAML::Node& node,
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

MimicPolicy ReadMimic(const ProfileReader& reader, const YAML::Node& node) {
  const std::string text = reader.Text(node, "mimic");
  if (text == "free") return MimicPolicy::kFree;
  if (text == "coupled") return MimicPolicy::kCoupled;
  if (text == "locked") return MimicPolicy::kLocked;
  reader.Refuse(node, "mimic", "free, coupled or locked");
}

// Reads the keys `forward`, `left` and `right`.
void ReadSides(const ProfileReader& reader, const YAML::Node& root,
               Sides* sides) {
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
std::vector<Foot> MakeFeet(const RobotModel& model, const Profile& profile,
                           std::vector<Finding>* findings) {
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
    foot->source = sole.source;
    feet.push_back(*std::move(foot));
    if (findings != nullptr && sole.source == SoleSource::kGuess) {
      findings->push_back(
          {Severity::kWarn, "sole of link " + Quoted(sole.frame),
           "is a guess, by line " + std::to_string(sole.line) +
               " of the profile",
           "measure the sole, correct it, and remove `from: guess`", 0});
    }
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
  const ProfileReader reader{file.string()};
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
      profile.feet.push_back(ReadSole(reader, name, feet[name]));
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
  std::map<std::string, Inertia> added = MakePointInertias(model);
  if (!added.empty()) model = urdf.MakeModel(locked, added);
  const std::map<std::string, Inertia> small = MakeSmallInertias(model);
  added.insert(small.begin(), small.end());
  if (!small.empty()) model = urdf.MakeModel(locked, added);
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
                   : MakeFeet(robot.model, profile, findings);
  if (!profile.feet.empty()) {
    const std::string reason = WhyNoPairOfFeet(robot);
    if (!reason.empty()) {
      throw Refusal(file, profile.feet[0].line, "feet: " + reason);
    }
  }
  CheckSides(robot, profile.sides, file, !profile.feet.empty());
  if (findings != nullptr) {
    for (Finding& finding :
         FindSideDefects(robot, profile.sides, !profile.feet.empty())) {
      findings->push_back(std::move(finding));
    }
  }
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
