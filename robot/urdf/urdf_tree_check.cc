// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_tree_check.h"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "poise/robot/finding.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;

// The joints, as edges of a graph of links.
struct Edges {
  Elements joint_above;  // The parent joint of each link, by link.
  std::unordered_map<std::string, std::vector<std::string>> children;
};

// Returns the edges. Returns nothing if a joint does not connect two links, or
// if a link has two parents.
std::optional<Edges> FindEdges(const UrdfTree& tree, const Elements& links,
                               const Elements& joints, const Critic& critic) {
  Edges edges;
  bool is_sound = true;
  for (const std::string& name : tree.joints) {
    const XMLElement& joint = *joints.at(name);
    const std::string parent = Text(*joint.FirstChildElement("parent"), "link");
    const std::string child = Text(*joint.FirstChildElement("child"), "link");
    for (const std::string& link : {parent, child}) {
      if (links.count(link) != 0) continue;
      critic.Reject(joint, "connects " + Quoted(link), "there is no such link");
      is_sound = false;
    }
    if (parent == child) {
      critic.Reject(joint, "connects " + Quoted(parent) + " to itself",
                    "must connect two different links");
      is_sound = false;
    }
    const auto [above, is_first] = edges.joint_above.emplace(child, &joint);
    if (!is_first && links.count(child) != 0) {
      critic.Reject(*links.at(child),
                    "has two parents, by joint " +
                        Quoted(Text(*above->second, "name")) + " and by " +
                        Quoted(name),
                    "must have one: loops are not supported");
      is_sound = false;
    }
    edges.children[parent].push_back(child);
  }
  if (!is_sound) return std::nullopt;
  return edges;
}

size_t CountBelow(const std::string& root, const Edges& edges) {
  size_t reached = 0;
  std::vector<std::string> open = {root};
  while (!open.empty()) {
    const std::string link = open.back();
    open.pop_back();
    ++reached;
    const auto below = edges.children.find(link);
    if (below == edges.children.end()) continue;
    open.insert(open.end(), below->second.begin(), below->second.end());
  }
  return reached;
}

// Returns the root of all links, or nothing if there is not exactly one.
std::optional<std::string> FindRoot(const XMLElement& robot,
                                    const std::vector<std::string>& names,
                                    const Elements& links, const Edges& edges,
                                    const Critic& critic) {
  std::vector<std::string> roots;
  for (const std::string& link : names) {
    if (edges.joint_above.count(link) == 0) roots.push_back(link);
  }
  if (roots.empty()) {
    critic.Reject(robot, "has no root", "the joints form a cycle");
    return std::nullopt;
  }
  if (roots.size() > 1) {
    critic.Reject(*links.at(roots[1]),
                  "is a second root beside " + Quoted(roots[0]),
                  "must be the child of a joint");
    return std::nullopt;
  }
  const size_t reached = CountBelow(roots[0], edges);
  if (reached == names.size()) return roots[0];
  critic.Reject(robot,
                std::to_string(names.size() - reached) +
                    " of its links are not below its root " + Quoted(roots[0]),
                "they are in or below a cycle of joints");
  return std::nullopt;
}

bool IsMassless(const XMLElement& link) {
  const XMLElement* inertial = link.FirstChildElement("inertial");
  return inertial == nullptr ||
         Number(*inertial->FirstChildElement("mass"), "value", 0) == 0;
}

void Remove(const std::unordered_set<std::string>& names,
            std::vector<std::string>* from) {
  from->erase(std::remove_if(from->begin(), from->end(),
                             [&](const std::string& name) {
                               return names.count(name) != 0;
                             }),
              from->end());
}

void LeaveOutWorld(const std::string& root, const Elements& links,
                   const Edges& edges, UrdfTree* tree) {
  std::unordered_set<std::string> world_links, world_joints;
  tree->base = root;
  for (std::string link = root; IsMassless(*links.at(link));) {
    const auto children = edges.children.find(link);
    if (children == edges.children.end() || children->second.size() != 1) break;
    world_links.insert(link);
    link = children->second[0];
    const XMLElement& joint = *edges.joint_above.at(link);
    world_joints.insert(Text(joint, "name"));
    if (Text(joint, "type") == "floating") tree->base = link;
    if (Text(joint, "type") != "fixed") break;
  }
  if (tree->base == root) return;
  Remove(world_links, &tree->links);
  Remove(world_joints, &tree->joints);
}

// Rejects a robot without mass, because its joint-space inertia M is zero in
// each posture.
void CheckMass(const XMLElement& robot, const Elements& links,
               const std::vector<std::string>& names, const Critic& critic) {
  if (std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return !IsMassless(*links.at(name));
      })) {
    return;
  }
  critic.Reject(robot, "the mass of all links together is 0",
                "must be positive, else M is singular: give the links an "
                "<inertial>");
}

}  // namespace

void CheckTree(const XMLElement& robot, const Elements& links,
               const Elements& joints, const Critic& critic, UrdfTree* tree) {
  const std::optional<Edges> edges = FindEdges(*tree, links, joints, critic);
  if (!edges || tree->links.empty()) return;
  const auto root = FindRoot(robot, tree->links, links, *edges, critic);
  if (!root) return;
  LeaveOutWorld(*root, links, *edges, tree);
  CheckMass(robot, links, tree->links, critic);
  for (const std::string& name : tree->joints) {
    if (Text(*joints.at(name), "type") != "floating") continue;
    critic.Reject(*joints.at(name), "is floating",
                  "only one joint below the massless root may be floating");
  }
  for (const std::string& name : tree->links) {
    const XMLElement& link = *links.at(name);
    const bool is_base = name == tree->base;
    if (is_base && name == "world") {
      critic.Note(link, "is the root",
                  "the robot has a floating base: it is not fixed to the "
                  "ground");
    } else if (link.FirstChildElement("inertial") == nullptr &&
               (is_base || IsMoving(*edges->joint_above.at(name)))) {
      critic.Note(link, "has no <inertial>", "its mass is treated as 0");
    }
  }
}

}  // namespace poise
