// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/collision/body_capsules.h"
#include "poise/robot/collision/capsule.h"
#include "poise/robot/collision/closest_points.h"
#include "poise/robot/robot.h"

namespace poise {

/// Two bodies of the tree that may collide.
struct CollisionPair {
  int a = 0;         ///< The smaller index.
  int b = 0;         ///< The larger index.
  int ancestor = 0;  ///< Last common body of their chains; may be a.
};

/// A ball around all capsules of a body, in the frame of the body.
struct CollisionBound {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m.
  double radius = 0;                                 ///< m.
};

/// The capsules of a robot, and the pairs of bodies that may collide.
struct CollisionModel {
  /// By body of the tree, in its frame, see FitBodyCapsules().
  std::vector<std::vector<Capsule>> capsules;
  std::vector<CollisionBound> bounds;  ///< By body of the tree.
  std::vector<CollisionPair> pairs;
  std::vector<std::string> names;  ///< By body: the link that its joint moves.
  double reach = 0;                ///< Scale of distances, m; see Reach().
};

/// Fits the capsules, and selects the pairs of bodies. Left out are
/// - bodies that one joint connects, or several within a quarter of the reach,
///   as a pelvis and a thigh: the limits of these joints keep them apart;
/// - bodies that touch in nearly all of the random postures, as the two ends of
///   a hip with three joints do: they touch by construction;
/// - bodies that come nowhere near each other in these postures, or that never
///   touch and have at most two joints between them.
/// The postures have joint angles inside the limits and obey mimic couplings. A
/// fixed seed draws them, so that a model is a function of the robot. A robot
/// with very many pairs keeps those that come nearest, 200 at most.
///
/// Throws std::invalid_argument if a number of a shape is not finite.
/// For setup: costs a few milliseconds for 50 joints.
CollisionModel MakeCollisionModel(const RobotModel& model,
                                  const SurfacePoints& points = {});

/// Returns a lower bound of the distance of a pair, m, from the balls around
/// its bodies: a quick test. Does not allocate, does not throw.
double BoundPairDistance(const CollisionModel& model, const CollisionPair& pair,
                         const std::vector<Pose>& X_WB) noexcept;

/// Computes the closest points of the nearest capsules of a pair, in the world.
/// @param X_WB      by body, from ComputePoses() or a Tick.
/// @param softness  see ComputeClosestPoints().
/// Does not allocate, does not throw.
ClosestPoints ComputePairDistance(const CollisionModel& model,
                                  const CollisionPair& pair,
                                  const std::vector<Pose>& X_WB,
                                  double softness) noexcept;

/// The smallest distance of all pairs, and the index of that pair. Without
/// pairs the distance is infinite and the index is -1.
struct Clearance {
  double distance;  ///< m; negative if the capsules overlap.
  int pair;
};

/// Computes the clearance in a posture. Does not allocate, does not throw.
Clearance ComputeClearance(const CollisionModel& model,
                           const std::vector<Pose>& X_WB) noexcept;

}  // namespace poise
