// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/stand.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "poise/robot/control/posture/find_posture.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

using Eigen::VectorXd;

constexpr double kKneeBend = 0.6;  // rad.
// A joint that moves less than this fraction of the mass, and no foot, belongs
// to an arm or a head.
constexpr double kArmMass = 0.15;
// Random starts of each search, and their largest change of a joint, rad or m.
constexpr int kRandomStarts = 8;
constexpr double kFarthestStart = 1;

// Returns which joints belong to neither legs nor trunk. A joint of a mimic
// coupling is not among them, because its partner may move.
std::vector<bool> Arms(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  const int n = tree.num_joints();
  VectorXd mass(n + 1);
  for (int b = 0; b <= n; ++b) mass[b] = tree.inertias()[b].mass;
  for (int b = n; b > 0; --b) mass[tree.joints()[b - 1].parent] += mass[b];
  std::vector<bool> arms(n);
  for (int j = 0; j < n; ++j) arms[j] = mass[j + 1] < kArmMass * mass[0];
  for (const Foot& foot : robot.feet) {
    for (int b = foot.body; b > 0; b = tree.joints()[b - 1].parent) {
      arms[b - 1] = false;
    }
  }
  for (const MimicCoupling& mimic : robot.model.mimics) {
    arms[mimic.joint] = arms[mimic.source] = false;
  }
  return arms;
}

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

  // Returns the reason why no start led to a posture.
  std::string Reason() const;

 private:
  const Robot& robot_;
  int tried_ = 0;
  Posture best_{{}, "", std::numeric_limits<double>::infinity(), {}};
};

bool Starts::Try(const PostureGoal& goal) {
  ++tried_;
  Posture posture = FindPosture(robot_, goal);
  const bool stands = posture.lack.empty();
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

}  // namespace

void StandUp(Robot* robot) {
  if (robot->feet.size() != 2 || !(robot->model.tree.total_mass() > 0)) {
    throw std::invalid_argument("robot " + Quoted(robot->model.name) +
                                " cannot stand: it must have two feet and "
                                "a mass");
  }
  Starts starts(*robot);
  const auto stands = [&] {
    PostureGoal goal;
    if (starts.TryBends(goal)) return true;
    // The search with arms at rest is smaller. It converges where arms would
    // lead it away.
    goal.fixed = Arms(*robot);
    for (const bool are_soles_parallel : {true, false}) {
      goal.are_soles_parallel = are_soles_parallel;
      for (const bool is_base_upright : {false, true}) {
        goal.is_base_upright = is_base_upright;
        if (starts.TryBends(goal)) return true;
      }
      if (starts.TryRandom(goal)) return true;
    }
    return false;
  };
  if (!stands()) {
    throw std::invalid_argument(
        "robot " + Quoted(robot->model.name) +
        ": no standing posture within the joint limits: " + starts.Reason());
  }
  robot->q_nominal = starts.best().q;
  robot->can_stand = true;
}

Robot MakeStandingRobot(const UrdfDocument& urdf, const Profile& profile,
                        std::vector<Finding>* findings) {
  try {
    Robot robot = MakeRobot(urdf, profile, findings);
    if (!robot.can_stand) StandUp(&robot);
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
