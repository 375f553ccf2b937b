// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_check.h"

#include <algorithm>
#include <string_view>
#include <unordered_set>

#include "poise/robot/urdf/urdf_grammar.h"
#include "poise/robot/urdf/urdf_mimic_check.h"
#include "poise/robot/urdf/urdf_part_check.h"
#include "poise/robot/urdf/urdf_xml.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;

// Bounds the memory. It is far above the number of links of any robot.
constexpr size_t kMostLinks = 100'000;

// Returns the names in the file's order, and collects the elements by name.
std::vector<std::string> CheckNames(const XMLElement& robot, const char* kind,
                                    const Critic& critic, Elements* elements) {
  std::vector<std::string> names;
  for (const XMLElement* element = robot.FirstChildElement(kind);
       element != nullptr; element = element->NextSiblingElement(kind)) {
    const std::string name = Text(*element, "name");
    if (name.empty()) {
      if (element->Attribute("name") != nullptr) {
        critic.Reject(*element, "its name is empty", "must have a name");
      }
    } else if (!elements->emplace(name, element).second) {
      critic.Reject(*element, "occurs twice", "names must be unique");
    } else {
      names.push_back(name);
    }
  }
  return names;
}

void CheckLink(const XMLElement& link, const Critic& critic) {
  CheckInertial(link, critic);
  for (const char* shape : {"visual", "collision"}) {
    for (const XMLElement* element = link.FirstChildElement(shape);
         element != nullptr; element = element->NextSiblingElement(shape)) {
      CheckOrigin(*element, critic);
    }
  }
}

void CheckType(const XMLElement& joint, const Critic& critic) {
  const std::string type = Text(joint, "type");
  if (IsMoving(joint) || type == "fixed" || type == "floating") return;
  critic.Reject(joint, "its type is " + Quoted(type),
                "must be revolute, continuous, prismatic or fixed");
}

UrdfFacts CheckRobot(const XMLElement& robot, const Critic& critic) {
  UrdfFacts facts;
  UrdfTree& tree = facts.tree;
  Elements links, joints;
  tree.links = CheckNames(robot, "link", critic, &links);
  tree.joints = CheckNames(robot, "joint", critic, &joints);
  if (tree.links.empty()) {
    critic.Reject(robot, "has no link", "must have at least one");
  }
  if (tree.links.size() > kMostLinks) {
    critic.Reject(robot, "has " + std::to_string(tree.links.size()) + " links",
                  "must have at most 100000");
    return facts;
  }
  for (const std::string& name : tree.links) CheckLink(*links[name], critic);
  for (const std::string& name : tree.joints) {
    const XMLElement& joint = *joints[name];
    CheckType(joint, critic);
    CheckOrigin(joint, critic);
    if (!IsMoving(joint)) continue;
    CheckAxis(joint, critic);
    facts.limits[name] = CheckLimits(joint, critic);
  }
  CheckMimics(tree.joints, joints, facts.limits, critic);
  CheckTree(robot, links, joints, critic, &tree);
  return facts;
}

// Removes each material whose name occurred before, so that the first one is
// used.
void PruneMaterials(XMLElement* robot, const Critic& critic) {
  std::unordered_set<std::string> names;
  XMLElement* material = robot->FirstChildElement("material");
  while (material != nullptr) {
    XMLElement* next = material->NextSiblingElement("material");
    if (!names.insert(Text(*material, "name")).second) {
      critic.Warn(*material, "occurs twice", "only the first one is used");
      robot->DeleteChild(material);
    }
    material = next;
  }
}

}  // namespace

UrdfFacts CheckUrdf(tinyxml2::XMLDocument* document,
                    std::vector<Finding>* findings) {
  XMLElement* robot = document->RootElement();
  const auto reject = [&](const std::string& what, const std::string& why,
                          int line) {
    findings->push_back({Severity::kReject, "", what, why, line});
  };
  if (robot == nullptr) {
    reject("has no element", "must have a <robot>", 0);
    return {};
  }
  const std::string_view name = robot->Name();
  if (name != "robot") {
    reject("is a <" + std::string(name.substr(0, 40)) + ">",
           name == "sdf"      ? "which is SDF, must be URDF: <robot>; "
                                "export the robot as URDF"
           : name == "mujoco" ? "which is MJCF, must be URDF: <robot>; "
                                "export the robot as URDF"
                              : "must be a <robot>",
           robot->GetLineNum());
    return {};
  }
  if (const XMLElement* second = robot->NextSiblingElement()) {
    reject("has a second root element", "must have only one <robot>",
           second->GetLineNum());
    return {};
  }
  PruneUrdf(robot, findings);
  const bool is_pruned = std::none_of(
      findings->begin(), findings->end(),
      [](const Finding& f) { return f.severity == Severity::kReject; });
  PruneMaterials(robot, Critic(findings));
  return is_pruned ? CheckRobot(*robot, Critic(findings)) : UrdfFacts{};
}

}  // namespace poise
