// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stand.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "poise/robot/control/posture/arms.h"
#include "poise/robot/control/posture/find_posture.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

using Eigen::VectorXd;

constexpr double kKneeBend = 0.6;  // rad.
// Random starts of each search, and their largest change of a joint, rad or m.
constexpr int kRandomStarts = 8;
constexpr double kFarthestStart = 1;

// Searches a posture from several starts, and keeps the best one.
class Starts {
 public:
  explicit Starts(const Robot& robot) : robot_(robot) {}

  // Searches from one start. Returns true if the robot stands.
  bool Try(const PostureGoal& goal);

  // Tries bent knees: forward, then unchanged, then backward.
  bool TryBends(PostureGoal goal);

  // Tries starts with random joints of legs and trunk.
  bool TryRandom(PostureGoal goal);

  const Posture& best() const { return best_; }

  // Returns whether the center of mass was the only error of a search.
  bool are_soles_flat() const { return are_soles_flat_; }

  // Returns the reason why no start led to a posture.
  std::string Reason() const;

 private:
  const Robot& robot_;
  int tried_ = 0;
  bool are_soles_flat_ = false;
  Posture best_{{}, "", std::numeric_limits<double>::infinity(), false, {}};
};

bool Starts::Try(const PostureGoal& goal) {
  ++tried_;
  Posture posture = FindPosture(robot_, goal);
  const bool stands = posture.lack.empty();
  are_soles_flat_ |= posture.are_soles_flat;
  if (stands || best_.q.size() == 0 || posture.error < best_.error) {
    best_ = std::move(posture);
  }
  return stands;
}

bool Starts::TryBends(PostureGoal goal) {
  for (const double bend : {kKneeBend, 0., -kKneeBend}) {
    goal.knee_bend = bend;
    if (Try(goal)) return true;
  }
  return false;
}

bool Starts::TryRandom(PostureGoal goal) {
  goal.knee_bend = kKneeBend;
  const int start = robot_.model.tree.q_start();
  const int n = robot_.model.tree.num_joints();
  std::mt19937 random(1);  // Its numbers are the same on all machines.
  for (int i = 0; i < kRandomStarts; ++i) {
    goal.start = robot_.q_nominal.segment(start, n);
    for (int j = 0; j < n; ++j) {
      const double u =
          static_cast<double>(random()) / 2147483648 - 1;  // From -1 to 1.
      if (!goal.fixed[j]) goal.start[j] += kFarthestStart * u;
    }
    if (Try(goal)) return true;
  }
  return false;
}

std::string Starts::Reason() const {
  constexpr size_t kNamed = 4;
  const Tree& tree = robot_.model.tree;
  std::string text = best_.lack;
  for (size_t i = 0; i < std::min(kNamed, best_.at_limit.size()); ++i) {
    const int j = best_.at_limit[i];
    text += (i == 0 ? "; at or near their limits are " : ", ") +
            Quoted(tree.joints()[j].name) + " (" +
            PrintNumber(best_.q[tree.q_start() + j]) + ")";
  }
  if (best_.at_limit.size() > kNamed) {
    text += " and " + std::to_string(best_.at_limit.size() - kNamed) + " more";
  }
  return text + "; " + std::to_string(tried_) + " starts were tried";
}

// Moves arms out of other bodies, and balances the robot with its new arms.
void MoveArmsAway(const std::vector<bool>& arms, const Profile& profile,
                  Robot* robot) {
  const Tree& tree = robot->model.tree;
  std::vector<bool> fixed(tree.num_joints());
  for (int j = 0; j < tree.num_joints(); ++j) {
    fixed[j] = !arms[j] || profile.joints.count(tree.joints()[j].name) != 0;
  }
  Robot spread = *robot;
  if (!SpreadArms(arms, fixed, &spread)) return;
  PostureGoal goal;
  goal.fixed = arms;
  for (const bool are_soles_parallel : {true, false}) {
    goal.are_soles_parallel = are_soles_parallel;
    const Posture posture = FindPosture(spread, goal);
    if (!posture.lack.empty()) continue;
    robot->q_nominal = posture.q;
    return;
  }
}

}  // namespace

void StandUp(Robot* robot, const Profile& profile) {
  if (robot->feet.size() != 2 || !(robot->model.tree.total_mass() > 0)) {
    throw std::invalid_argument("robot " + Quoted(robot->model.name) +
                                " cannot stand: it must have two feet and "
                                "a mass");
  }
  const std::vector<bool> arms = FindArms(*robot);
  Starts starts(*robot);
  const auto stands = [&] {
    PostureGoal goal;
    goal.knee_bend = kKneeBend;
    if (starts.Try(goal)) return true;
    // With fixed arms the search has fewer variables. It converges for some
    // robots whose arms would move far from rest.
    goal.fixed = arms;
    for (const bool are_soles_parallel : {true, false}) {
      goal.are_soles_parallel = are_soles_parallel;
      goal.is_base_upright = false;
      if (starts.TryBends(goal)) return true;
      goal.is_base_upright = true;
      if (starts.TryRandom(goal)) return true;
    }
    // Arms may balance a robot that cannot stand with its arms at rest.
    goal = PostureGoal{};
    return starts.are_soles_flat() && starts.TryBends(goal);
  };
  if (!stands()) {
    throw std::invalid_argument(
        "robot " + Quoted(robot->model.name) +
        ": no standing posture within the joint limits: " + starts.Reason());
  }
  robot->q_nominal = starts.best().q;
  robot->can_stand = true;
  MoveArmsAway(arms, profile, robot);
}

Robot MakeStandingRobot(const UrdfDocument& urdf, const Profile& profile,
                        std::vector<Finding>* findings) {
  try {
    Robot robot = MakeRobot(urdf, profile, findings);
    if (!robot.can_stand) StandUp(&robot, profile);
    return robot;
  } catch (const Refusal&) {  // Its message already names the file.
    throw;
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(urdf.source() + ": " + error.what());
  }
}

Robot LoadStandingRobot(const std::filesystem::path& urdf,
                        const Profile& profile,
                        std::vector<Finding>* findings) {
  return MakeStandingRobot(UrdfDocument(urdf, findings), profile, findings);
}

}  // namespace poise
