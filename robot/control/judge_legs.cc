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
    std::string slow;
    for (const int j : joints) {
      const Joint& joint = robot.model.tree.joints()[j];
      const double limit = robot.model.limits[j].velocity;
      if (joint.type == JointType::kPrismatic) continue;
      if (!(limit > 0 && limit < kSlowestVelocity)) continue;
      slow += (slow.empty() ? "" : ", ") + Quoted(joint.name) + " " +
              PrintNumber(limit) + " rad/s";
    }
    if (slow.empty()) continue;
    findings.push_back({Severity::kWarn, LegOf(foot) + " <limit>",
                        "has the velocity limits " + slow,
                        "may be placeholders: balance needs faster legs, and "
                        "control assumes at least " +
                            PrintNumber(kSlowestVelocity) +
                            " rad/s; give the motors' real limits"});
  }
  return findings;
}

}  // namespace poise
