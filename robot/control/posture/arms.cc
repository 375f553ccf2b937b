// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/posture/arms.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/collision/body_capsules.h"
#include "poise/robot/collision/collision_model.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using Eigen::VectorXd;

constexpr double kArmMass = 0.15;    // See FindArms().
constexpr double kClearance = 0.02;  // m.
constexpr double kClearanceOfReach = 0.03;
constexpr int kMostMoves = 3;          // Joints of an arm that move.
constexpr double kStep = 0.05;         // rad.
constexpr int kSteps = 24;             // Farthest move: 1.2 rad.
constexpr double kAlongForward = 0.8;  // Cosine of an axis for abduction.
// Smallest gain of a move that does not suffice, relative to the clearance.
constexpr double kLeastGain = 0.05;

// Bodies with at most so many joints between them are near by construction.
constexpr int kFewJoints = 2;

// Returns the number of joints between two bodies.
int JointsBetween(const Tree& tree, const CollisionPair& pair) {
  int joints = 0;
  for (const int body : {pair.a, pair.b}) {
    for (int b = body; b != pair.ancestor; b = tree.joints()[b - 1].parent) {
      ++joints;
    }
  }
  return joints;
}

// A move of one joint, and the distance after the move.
struct Move {
  int joint;
  double step;
  double distance;
};

// One arm: the joints beyond a joint that carries no trunk.
class Arm {
 public:
  // A shoulder is the first body of an arm.
  Arm(const CollisionModel& collision, int root,
      const std::vector<bool>& shoulders, const std::vector<bool>& fixed,
      Robot* robot);

  // Moves joints. Returns true if a joint was moved.
  bool Spread(double clearance);

 private:
  bool IsIn(int body) const { return body >= first_ && body < end_; }

  // Returns the smallest distance of the arm's bodies from all bodies, m.
  double Distance(const VectorXd& q);

  // Returns whether the joint turns about the forward axis, in q_nominal.
  bool Abducts(int joint);

  // Returns the smallest move of one of the joints that gives the clearance;
  // without one, the move that gives the largest distance.
  std::optional<Move> Best(const std::vector<int>& joints, double clearance);

  const CollisionModel& collision_;
  Robot* robot_;
  int first_, end_;  // Range of the arm's bodies: a subtree is contiguous.
  std::vector<const CollisionPair*> pairs_;
  std::vector<int> joints_;  // That may move and that move a pair's body.
  std::vector<Pose> X_WB_;
};

Arm::Arm(const CollisionModel& collision, int root,
         const std::vector<bool>& shoulders, const std::vector<bool>& fixed,
         Robot* robot)
    : collision_(collision),
      robot_(robot),
      first_(root + 1),
      end_(root + 2),
      X_WB_(robot->model.tree.num_bodies()) {
  const Tree& tree = robot->model.tree;
  while (end_ < tree.num_bodies() && IsIn(tree.joints()[end_ - 1].parent)) {
    ++end_;
  }
  std::vector<bool> moves(tree.num_bodies());
  ComputePoses(tree, robot->q_nominal, &X_WB_);
  for (const CollisionPair& pair : collision.pairs) {
    if (!IsIn(pair.a) && !IsIn(pair.b)) continue;
    // Shoulders are near other bodies by construction, and an elbow is near the
    // trunk. Capsules that overlap there still count.
    if (shoulders[pair.a] || shoulders[pair.b]) continue;
    if (JointsBetween(tree, pair) <= kFewJoints &&
        ComputePairDistance(collision, pair, X_WB_, 0).distance >= 0) {
      continue;
    }
    pairs_.push_back(&pair);
    for (const int body : {pair.a, pair.b}) {
      for (int b = body; IsIn(b); b = tree.joints()[b - 1].parent) {
        moves[b] = true;
      }
    }
  }
  for (int b = first_; b < end_; ++b) {
    if (!moves[b] || fixed[b - 1]) continue;
    if (tree.joints()[b - 1].type != JointType::kPrismatic) {
      joints_.push_back(b - 1);
    }
  }
}

double Arm::Distance(const VectorXd& q) {
  ComputePoses(robot_->model.tree, q, &X_WB_);
  double distance = std::numeric_limits<double>::infinity();
  for (const CollisionPair* pair : pairs_) {
    if (BoundPairDistance(collision_, *pair, X_WB_) > distance) continue;
    distance = std::min(
        distance, ComputePairDistance(collision_, *pair, X_WB_, 0).distance);
  }
  return distance;
}

bool Arm::Abducts(int joint) {
  const Tree& tree = robot_->model.tree;
  ComputePoses(tree, robot_->q_nominal, &X_WB_);
  // The robot faces +x. The joint's axis is the same in both of its bodies.
  const Eigen::Vector3d axis_W =
      X_WB_[joint + 1].R * tree.joints()[joint].axis_F;
  return std::abs(axis_W.x()) > kAlongForward;
}

std::optional<Move> Arm::Best(const std::vector<int>& joints,
                              double clearance) {
  std::optional<Move> best;
  VectorXd q = robot_->q_nominal;
  for (int k = 1; k <= kSteps; ++k) {
    for (const int joint : joints) {
      double& angle = q[robot_->model.tree.q_start() + joint];
      const double start = angle;
      for (const double step : {k * kStep, -k * kStep}) {
        angle = start + step;
        if (!IsWithin(robot_->model.limits[joint], angle)) continue;
        const double distance = Distance(q);
        if (!best || distance > best->distance) {
          best = Move{joint, step, distance};
        }
      }
      angle = start;
    }
    if (best && best->distance >= clearance) return best;
  }
  return best;
}

bool Arm::Spread(double clearance) {
  double distance = Distance(robot_->q_nominal);
  std::vector<int> abducting;
  for (const int joint : joints_) {
    if (Abducts(joint)) abducting.push_back(joint);
  }
  bool has_moved = false;
  for (int i = 0; i < kMostMoves && distance < clearance; ++i) {
    std::optional<Move> move = Best(abducting, clearance);
    if (!move || move->distance < clearance) move = Best(joints_, clearance);
    if (!move) break;
    if (move->distance <
        std::min(clearance, distance + kLeastGain * clearance)) {
      break;
    }
    robot_->q_nominal[robot_->model.tree.q_start() + move->joint] += move->step;
    distance = move->distance;
    has_moved = true;
  }
  return has_moved;
}

}  // namespace

std::vector<bool> FindArms(const Robot& robot) {
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

double ArmClearance(const RobotModel& model) {
  return std::min(kClearance, kClearanceOfReach * Reach(model.tree));
}

bool SpreadArms(const std::vector<bool>& arms, const std::vector<bool>& fixed,
                Robot* robot) {
  const Tree& tree = robot->model.tree;
  const CollisionModel collision = MakeCollisionModel(robot->model);
  const double clearance = ArmClearance(robot->model);
  std::vector<bool> shoulders(tree.num_bodies());
  for (int j = 0; j < tree.num_joints(); ++j) {
    const int parent = tree.joints()[j].parent;
    shoulders[j + 1] = arms[j] && (parent == 0 || !arms[parent - 1]);
  }
  bool has_moved = false;
  for (int j = 0; j < tree.num_joints(); ++j) {
    if (!shoulders[j + 1]) continue;
    has_moved |= Arm(collision, j, shoulders, fixed, robot).Spread(clearance);
  }
  return has_moved;
}

}  // namespace poise
