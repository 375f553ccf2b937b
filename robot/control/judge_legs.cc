// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/judge_legs.h"

#include <algorithm>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/tasks/joint_limits.h"
#include "poise/robot/control/tasks/loop_closure.h"

namespace poise {
namespace {

// Returns "left leg" for "left_foot".
std::string LegOf(const Foot& foot) {
  const size_t end = foot.name.find("_foot");
  return end == std::string::npos ? "leg of " + Quoted(foot.name)
                                  : foot.name.substr(0, end) + " leg";
}

std::vector<int> JointsOfLeg(const Robot& robot, const Foot& leg) {
  const Tree& tree = robot.model.tree;
  std::vector<int> joints = JointsTo(tree, leg.body);
  for (const Foot& other : robot.feet) {
    if (other.body == leg.body) continue;
    const std::vector<int> shared = JointsTo(tree, other.body);
    joints.erase(std::remove_if(joints.begin(), joints.end(),
                                [&](int j) {
                                  return std::count(shared.begin(),
                                                    shared.end(), j) > 0;
                                }),
                 joints.end());
  }
  return joints;
}

// Returns the number of joints in the longest chain that a body carries.
int JointsBeyond(const Tree& tree, int body) {
  std::vector<int> depth(tree.num_bodies(), -1);
  depth[body] = 0;
  for (int b = body + 1; b < tree.num_bodies(); ++b) {
    const int parent = depth[tree.joints()[b - 1].parent];
    if (parent >= 0) depth[b] = parent + 1;
  }
  return *std::max_element(depth.begin(), depth.end());
}

}  // namespace

std::vector<Finding> JudgeLegs(const Robot& robot) {
  std::vector<Finding> findings;
  for (const Foot& foot : robot.feet) {
    const std::vector<int> joints = JointsOfLeg(robot, foot);
    const int missing = 6 - static_cast<int>(joints.size());
    // A foot that is the base has no leg of its own.
    if (missing > 0 && missing < 6) {
      findings.push_back(
          {Severity::kWarn, LegOf(foot),
           "has " + std::to_string(joints.size()) + " joints",
           std::to_string(missing) +
               (missing == 1 ? " direction of its sole is"
                             : " directions of its sole are") +
               " not controlled: on one foot, balance is limited"});
    }
    const int beyond = JointsBeyond(robot.model.tree, foot.body);
    if (beyond > 1) {
      findings.push_back(
          {Severity::kWarn, foot.name,
           "carries a chain of " + std::to_string(beyond) + " joints",
           "a foot is the last link of a leg, or has toes of one joint: name "
           "the last link in the profile"});
    }
    std::vector<int> slow;
    for (const int j : joints) {
      if (robot.model.tree.joints()[j].type == JointType::kPrismatic) continue;
      const double limit = robot.model.limits[j].velocity;
      if (limit > 0 && limit < kSlowestVelocity) slow.push_back(j);
    }
    if (slow.empty()) continue;
    const auto limit_of = [&](int j) { return robot.model.limits[j].velocity; };
    const int slowest = *std::min_element(
        slow.begin(), slow.end(),
        [&](int i, int j) { return limit_of(i) < limit_of(j); });
    const std::string least = PrintNumber(kSlowestVelocity) + " rad/s";
    findings.push_back(
        {Severity::kWarn, LegOf(foot) + " <limit>",
         "has " + std::to_string(slow.size()) +
             (slow.size() == 1 ? " velocity limit" : " velocity limits") +
             " below " + least + ", the lowest " +
             PrintNumber(limit_of(slowest)) + " rad/s at joint " +
             Quoted(robot.model.tree.joints()[slowest].name),
         "may be placeholders: balance needs faster legs, and control assumes "
         "at least " +
             least + "; give the motors' real limits"});
  }
  return findings;
}

}  // namespace poise
