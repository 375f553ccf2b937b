// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/collision_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "poise/dynamics/kinematics.h"

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Random postures that select the pairs.
constexpr int kPostures = 200;

// A pair that touches in more than this fraction of the postures touches by
// construction.
constexpr double kMostlyTouching = 0.8;

// A pair that stays farther apart than this fraction of the reach, in all
// postures, is left out. Extreme postures are rare among the random ones.
constexpr double kNear = 0.25;

// The postures cover the motion of so many joints densely: a pair that touches
// in none of them cannot touch.
constexpr int kFewJoints = 2;

// Joints within this fraction of the reach count as one joint: a hip with three
// joints may be that large. The limits of its joints keep thigh and pelvis
// apart, while their capsules overlap.
constexpr double kClose = 0.25;

constexpr int kMostPairs = 200;

struct Candidate {
  CollisionPair pair;
  int touches = 0;
  double nearest = kInfinity;
};

int ParentOf(const Tree& tree, int body) {
  return tree.joints()[body - 1].parent;
}

int CommonAncestor(const Tree& tree, int a, int b) {
  // A parent has a smaller index than its children.
  while (a != b) {
    if (a > b) {
      a = ParentOf(tree, a);
    } else {
      b = ParentOf(tree, b);
    }
  }
  return a;
}

// Returns whether one joint, or several close to each other, connects a body
// with one of its ancestors: a thigh with the pelvis, by a hip of three joints.
bool AreNeighbors(const Tree& tree, double close, const CollisionPair& pair) {
  if (pair.ancestor != pair.a) return false;
  double way = 0;
  for (int body = pair.b; ParentOf(tree, body) != pair.a;
       body = ParentOf(tree, body)) {
    way += tree.joints()[body - 1].X_PF.p.norm();
  }
  return way <= close;
}

std::vector<Candidate> MakeCandidates(
    const Tree& tree, const std::vector<std::vector<Capsule>>& capsules) {
  const double close = kClose * Reach(tree);
  std::vector<Candidate> candidates;
  for (int b = 1; b < tree.num_bodies(); ++b) {
    for (int a = 0; a < b; ++a) {
      if (capsules[a].empty() || capsules[b].empty()) continue;
      const CollisionPair pair{a, b, CommonAncestor(tree, a, b)};
      if (!AreNeighbors(tree, close, pair)) candidates.push_back({pair});
    }
  }
  return candidates;
}

// Draws a posture inside the joint limits. The base does not matter.
void DrawPosture(const RobotModel& model, double reach, std::mt19937* random,
                 Eigen::VectorXd* q) {
  const Tree& tree = model.tree;
  for (int j = 0; j < tree.num_joints(); ++j) {
    const bool is_slider = tree.joints()[j].type == JointType::kPrismatic;
    const double most = is_slider ? reach : M_PI;
    const double lower = std::max(model.limits[j].lower, -most);
    const double upper = std::min(model.limits[j].upper, most);
    const double share = static_cast<double>((*random)()) / random->max();
    (*q)[tree.q_start() + j] = lower + share * (upper - lower);
  }
  for (const MimicCoupling& mimic : model.mimics) {
    (*q)[tree.q_start() + mimic.joint] =
        mimic.multiplier * (*q)[tree.q_start() + mimic.source] + mimic.offset;
  }
}

Capsule InWorld(const Pose& X_WB, const Capsule& capsule) noexcept {
  return {X_WB * capsule.start, X_WB * capsule.end, capsule.radius};
}

CollisionBound FindBound(const std::vector<Capsule>& capsules) {
  CollisionBound bound;
  const double n = static_cast<double>(capsules.size());
  for (const Capsule& c : capsules) bound.center += (c.start + c.end) / 2 / n;
  for (const Capsule& c : capsules) {
    for (const Eigen::Vector3d& p : {c.start, c.end}) {
      bound.radius =
          std::max(bound.radius, (p - bound.center).norm() + c.radius);
    }
  }
  return bound;
}

// Counts in how many random postures a pair touches, and finds its smallest
// distance, as far as that is below `near`.
void TryPostures(const RobotModel& model, const CollisionModel& collision,
                 double near, std::vector<Candidate>* candidates) {
  const Tree& tree = model.tree;
  std::mt19937 random(1);
  Eigen::VectorXd q = tree.MakeNeutral();
  std::vector<Pose> X_WB(tree.num_bodies());
  for (int i = 0; i < kPostures; ++i) {
    DrawPosture(model, collision.reach, &random, &q);
    ComputePoses(tree, q, &X_WB);
    for (Candidate& each : *candidates) {
      if (BoundPairDistance(collision, each.pair, X_WB) > near) continue;
      const double distance =
          ComputePairDistance(collision, each.pair, X_WB, 0).distance;
      each.touches += distance < 0;
      each.nearest = std::min(each.nearest, distance);
    }
  }
}

// Number of joints between two bodies.
int JointsBetween(const Tree& tree, const CollisionPair& pair) {
  int joints = 0;
  for (int body : {pair.a, pair.b}) {
    for (; body != pair.ancestor; body = ParentOf(tree, body)) ++joints;
  }
  return joints;
}

}  // namespace

double BoundPairDistance(const CollisionModel& model, const CollisionPair& pair,
                         const std::vector<Pose>& X_WB) noexcept {
  const CollisionBound& a = model.bounds[pair.a];
  const CollisionBound& b = model.bounds[pair.b];
  return (X_WB[pair.a] * a.center - X_WB[pair.b] * b.center).norm() - a.radius -
         b.radius;
}

ClosestPoints ComputePairDistance(const CollisionModel& model,
                                  const CollisionPair& pair,
                                  const std::vector<Pose>& X_WB,
                                  double softness) noexcept {
  ClosestPoints nearest;
  nearest.distance = kInfinity;
  for (const Capsule& a : model.capsules[pair.a]) {
    const Capsule A = InWorld(X_WB[pair.a], a);
    for (const Capsule& b : model.capsules[pair.b]) {
      const Capsule B = InWorld(X_WB[pair.b], b);
      const ClosestPoints closest = ComputeClosestPoints(A, B, softness);
      if (closest.distance < nearest.distance) nearest = closest;
    }
  }
  return nearest;
}

CollisionModel MakeCollisionModel(const RobotModel& model,
                                  const SurfacePoints& points) {
  const Tree& tree = model.tree;
  CollisionModel collision;
  collision.capsules = FitBodyCapsules(model, points);
  collision.reach = Reach(tree);
  collision.names.resize(tree.num_bodies());
  for (auto frame = tree.frames().rbegin(); frame != tree.frames().rend();
       ++frame) {
    collision.names[frame->body] = frame->name;  // The first one remains.
  }
  for (const auto& each : collision.capsules) {
    collision.bounds.push_back(FindBound(each));
  }
  std::vector<Candidate> candidates = MakeCandidates(tree, collision.capsules);
  const double near = kNear * collision.reach;
  TryPostures(model, collision, near, &candidates);
  const auto is_left_out = [&](const Candidate& each) {
    if (each.touches > kMostlyTouching * kPostures) return true;
    const bool is_covered = JointsBetween(tree, each.pair) <= kFewJoints;
    return each.nearest > (is_covered ? 0 : near);
  };
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(), is_left_out),
      candidates.end());
  if (candidates.size() > kMostPairs) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& x, const Candidate& y) {
                       return x.nearest < y.nearest;
                     });
    candidates.resize(kMostPairs);
  }
  for (const Candidate& each : candidates) {
    collision.pairs.push_back(each.pair);
  }
  return collision;
}

Clearance ComputeClearance(const CollisionModel& model,
                           const std::vector<Pose>& X_WB) noexcept {
  Clearance least{kInfinity, -1};
  for (size_t i = 0; i < model.pairs.size(); ++i) {
    const double distance =
        ComputePairDistance(model, model.pairs[i], X_WB, 0).distance;
    if (distance < least.distance) least = {distance, static_cast<int>(i)};
  }
  return least;
}

}  // namespace poise
