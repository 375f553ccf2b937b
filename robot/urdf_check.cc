// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/urdf_check.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "robot/urdf_grammar.h"
#include "robot/urdf_part_check.h"
#include "robot/urdf_xml.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;

// More links than these are no robot, and would fill the memory.
constexpr size_t kMostLinks = 100'000;

class Checker {
 public:
  Checker(const XMLElement& robot, std::vector<Finding>* findings)
      : robot_(robot), critic_(findings) {}

  UrdfFacts Check() {
    facts_.links = CheckNames("link", &links_);
    facts_.joints = CheckNames("joint", &joints_);
    if (facts_.links.empty()) {
      critic_.Reject(robot_, "has no link", "must have one");
    }
    if (facts_.links.size() > kMostLinks) {
      critic_.Reject(robot_,
                     "has " + std::to_string(facts_.links.size()) + " links",
                     "must have at most 100000");
      return facts_;
    }
    for (const std::string& name : facts_.links) {
      CheckInertial(*links_[name], critic_);
      for (const char* shape : {"visual", "collision"}) {
        for (const XMLElement* element = links_[name]->FirstChildElement(shape);
             element != nullptr; element = element->NextSiblingElement(shape)) {
          CheckOrigin(*element, critic_);
        }
      }
    }
    for (const std::string& name : facts_.joints) {
      const XMLElement& joint = *joints_[name];
      CheckType(joint);
      CheckOrigin(joint, critic_);
      if (!IsMoving(joint)) continue;
      CheckAxis(joint, critic_);
      facts_.limits[name] = CheckLimits(joint, critic_);
      CheckMimic(joint);
    }
    CheckMimicCycles();
    CheckMimicRanges();
    CheckTree();
    return facts_;
  }

 private:
  using Elements = std::unordered_map<std::string, const XMLElement*>;

  std::vector<std::string> CheckNames(const char* kind, Elements* elements) {
    std::vector<std::string> names;
    for (const XMLElement* element = robot_.FirstChildElement(kind);
         element != nullptr; element = element->NextSiblingElement(kind)) {
      const std::string name = Text(*element, "name");
      if (name.empty()) {
        if (element->Attribute("name") != nullptr) {
          critic_.Reject(*element, "its name is empty", "must have one");
        }
      } else if (!elements->emplace(name, element).second) {
        critic_.Reject(*element, "is there twice", "names must be unique");
      } else {
        names.push_back(name);
      }
    }
    return names;
  }

  void CheckType(const XMLElement& joint) {
    const std::string type = Text(joint, "type");
    if (IsMoving(joint) || type == "fixed" || type == "floating") return;
    critic_.Reject(joint, "its type is " + Quoted(type),
                   "must be revolute, continuous, prismatic or fixed");
  }

  void CheckMimic(const XMLElement& joint) {
    const XMLElement* mimic = joint.FirstChildElement("mimic");
    if (mimic == nullptr) return;
    const std::string source = Text(*mimic, "joint");
    const std::string what = "mimics " + Quoted(source);
    if (source == Text(joint, "name")) {
      critic_.Reject(joint, what, "must be another joint");
    } else if (joints_.count(source) == 0) {
      critic_.Reject(joint, what, "there is no such joint");
    } else if (!IsMoving(*joints_.at(source))) {
      critic_.Warn(joint, what,
                   "which does not move: the joint is independent");
    } else {
      critic_.Note(joint, what,
                   "it is independent unless the profile says otherwise");
    }
  }

  // Whoever follows whom, it must end at a joint that follows nobody.
  void CheckMimicCycles() {
    std::unordered_map<std::string, int> visit;
    for (size_t i = 0; i < facts_.joints.size(); ++i) {
      std::string name = facts_.joints[i];
      while (joints_.count(name) != 0 && visit.count(name) == 0) {
        visit[name] = static_cast<int>(i);
        const XMLElement* mimic = joints_[name]->FirstChildElement("mimic");
        const std::string source =
            mimic != nullptr ? Text(*mimic, "joint") : "";
        if (source == name) break;  // Rejected already.
        const auto seen = visit.find(source);
        if (seen != visit.end() && seen->second == static_cast<int>(i)) {
          critic_.Reject(*joints_[name], "mimics " + Quoted(source),
                         "which mimics it in turn");
        }
        name = source;
      }
    }
  }

  // Whether a joint that follows another one gets out of its own limits.
  void CheckMimicRanges() {
    constexpr double kTolerance = 1e-2;  // rad or m: files are rounded.
    for (const auto& [name, own] : facts_.limits) {
      const XMLElement* mimic = joints_[name]->FirstChildElement("mimic");
      if (mimic == nullptr) continue;
      const auto source = facts_.limits.find(Text(*mimic, "joint"));
      if (source == facts_.limits.end()) continue;
      const double multiplier = Number(*mimic, "multiplier", 1);
      const double offset = Number(*mimic, "offset", 0);
      for (const double end : {source->second.lower, source->second.upper}) {
        const double q = multiplier * end + offset;
        if (!std::isfinite(q) ||
            (q >= own.lower - kTolerance && q <= own.upper + kTolerance)) {
          continue;
        }
        critic_.Note(*mimic, "leads the joint to " + PrintNumber(q),
                     "which is outside its limits");
        break;
      }
    }
  }

  bool IsMassless(const std::string& link) const {
    const XMLElement* inertial = links_.at(link)->FirstChildElement("inertial");
    return inertial == nullptr ||
           Number(*inertial->FirstChildElement("mass"), "value", 0) == 0;
  }

  // Leaves out what stands for the world: massless links, one below the other,
  // down to a floating joint. Any other floating joint is rejected.
  void FindBase(
      const std::string& root,
      const std::unordered_map<std::string, std::vector<std::string>>& below,
      const std::unordered_map<std::string, const XMLElement*>& joint_above) {
    std::unordered_set<std::string> world_links, world_joints;
    facts_.base = root;
    for (std::string link = root; IsMassless(link);) {
      const auto children = below.find(link);
      if (children == below.end() || children->second.size() != 1) break;
      world_links.insert(link);
      link = children->second[0];
      const XMLElement& joint = *joint_above.at(link);
      world_joints.insert(Text(joint, "name"));
      if (Text(joint, "type") == "floating") facts_.base = link;
      if (Text(joint, "type") != "fixed") break;
    }
    if (facts_.base == root) {
      world_links.clear();
      world_joints.clear();
    }
    const auto remove = [](const std::unordered_set<std::string>& names,
                           std::vector<std::string>* from) {
      from->erase(std::remove_if(from->begin(), from->end(),
                                 [&](const std::string& name) {
                                   return names.count(name) != 0;
                                 }),
                  from->end());
    };
    remove(world_links, &facts_.links);
    remove(world_joints, &facts_.joints);
    for (const std::string& name : facts_.joints) {
      if (Text(*joints_[name], "type") != "floating") continue;
      critic_.Reject(*joints_[name], "is floating",
                     "only one below massless links from the root may be");
    }
    for (const std::string& link : facts_.links) {
      const auto above = joint_above.find(link);
      const bool is_base = link == facts_.base;
      if (is_base && link == "world") {
        critic_.Note(*links_[link], "is the root",
                     "the robot floats: it is not welded to the ground");
      } else if (links_[link]->FirstChildElement("inertial") == nullptr &&
                 (is_base || IsMoving(*above->second))) {
        critic_.Note(*links_[link], "has no <inertial>",
                     "its mass counts as 0");
      }
    }
  }

  // One root, one parent each, and all connected.
  void CheckTree() {
    std::unordered_map<std::string, const XMLElement*> joint_above;
    std::unordered_map<std::string, std::vector<std::string>> children;
    bool is_whole = true;
    for (const std::string& name : facts_.joints) {
      const XMLElement& joint = *joints_[name];
      const std::string parent =
          Text(*joint.FirstChildElement("parent"), "link");
      const std::string child = Text(*joint.FirstChildElement("child"), "link");
      for (const std::string& link : {parent, child}) {
        if (links_.count(link) != 0) continue;
        critic_.Reject(joint, "connects " + Quoted(link),
                       "there is no such link");
        is_whole = false;
      }
      if (parent == child) {
        critic_.Reject(joint, "connects " + Quoted(parent) + " to itself",
                       "must connect two links");
        is_whole = false;
      }
      const auto [above, is_first] = joint_above.emplace(child, &joint);
      if (!is_first && links_.count(child) != 0) {
        critic_.Reject(*links_[child],
                       "has two parents, by joint " +
                           Quoted(Text(*above->second, "name")) + " and by " +
                           Quoted(name),
                       "must have one: loops are not supported");
        is_whole = false;
      }
      children[parent].push_back(child);
    }
    std::vector<std::string> roots;
    for (const std::string& link : facts_.links) {
      if (joint_above.count(link) == 0) roots.push_back(link);
    }
    if (!is_whole || facts_.links.empty()) return;
    if (roots.size() > 1) {
      critic_.Reject(*links_[roots[1]],
                     "is a second root beside " + Quoted(roots[0]),
                     "must hang on a joint");
      return;
    }
    if (roots.empty()) {
      critic_.Reject(robot_, "has no root", "the joints form a cycle");
      return;
    }
    size_t reached = 0;
    std::vector<std::string> open = roots;
    while (!open.empty()) {
      const std::string link = open.back();
      open.pop_back();
      ++reached;
      const std::vector<std::string>& below = children[link];
      open.insert(open.end(), below.begin(), below.end());
    }
    if (reached < facts_.links.size()) {
      critic_.Reject(robot_,
                     std::to_string(facts_.links.size() - reached) +
                         " of its links do not hang on its root " +
                         Quoted(roots[0]),
                     "they are in or below a cycle");
      return;
    }
    FindBase(roots[0], children, joint_above);
  }

  const XMLElement& robot_;
  Critic critic_;
  UrdfFacts facts_;
  Elements links_;
  Elements joints_;
};

// Of materials with one name, the first one counts.
void PruneMaterials(XMLElement* robot, const Critic& critic) {
  std::unordered_set<std::string> names;
  XMLElement* material = robot->FirstChildElement("material");
  while (material != nullptr) {
    XMLElement* next = material->NextSiblingElement("material");
    if (!names.insert(Text(*material, "name")).second) {
      critic.Warn(*material, "is there twice", "the first one is read");
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
           name == "sdf"      ? "which is SDF, must be URDF: <robot>"
           : name == "mujoco" ? "which is MJCF, must be URDF: <robot>"
                              : "must be a <robot>",
           robot->GetLineNum());
    return {};
  }
  if (const XMLElement* second = robot->NextSiblingElement()) {
    reject("has a second root element", "must have <robot> alone",
           second->GetLineNum());
    return {};
  }
  PruneUrdf(robot, findings);
  const bool is_pruned = std::none_of(
      findings->begin(), findings->end(),
      [](const Finding& f) { return f.severity == Severity::kReject; });
  PruneMaterials(robot, Critic(findings));
  return is_pruned ? Checker(*robot, findings).Check() : UrdfFacts{};
}

}  // namespace poise
