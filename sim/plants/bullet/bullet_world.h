// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletCollisionCommon.h>

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/bullet/bullet_body.h"
#include "poise/sim/plants/bullet/bullet_settings.h"
#include "poise/sim/plants/plant_settings.h"

namespace poise {

/// A point where the ground presses on the robot.
struct GroundContact {
  int body;
  Eigen::Vector3d p_WQ;     ///< m.
  Eigen::Vector3d force_W;  ///< On the robot, N.
};

/// A Bullet world with a ground and one robot. It owns all Bullet objects,
/// because Bullet leaves the ownership to its user. Every episode needs a new
/// world: a used world does not repeat a run to the bit.
class BulletWorld {
 public:
  /// Throws std::invalid_argument, see BulletBody.
  BulletWorld(const Robot& robot, const PlantSettings& settings,
              const BulletSettings& bullet);
  ~BulletWorld();
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  BulletBody& body() { return body_; }

  /// Returns the pose of Bullet's link frame of a body, see BulletBody.
  Pose X_WL(int body) const {
    const btTransform& X =
        colliders_[static_cast<size_t>(body)]->getWorldTransform();
    return {FromBullet(X.getRotation()), FromBullet(X.getOrigin())};
  }

  /// Moves the colliders to the robot's state. All pairs of links that touch
  /// there are excluded from collisions from then on.
  void Place();

  void Step(double dt) {
    world_.stepSimulation(dt, /* maxSubSteps */ 0);
    MoveFootColliders();
  }

  /// Returns the points at which the ground pressed on the robot in the last
  /// step of dt, s. Valid until the next call.
  const std::vector<GroundContact>& FindGroundContacts(double dt);

  /// Finds the pairs of bodies that pressed on each other in the last step.
  void FindSelfContacts(std::vector<std::pair<int, int>>* pairs);

 private:
  // Restricts Bullet's collision detection to pairs that may collide.
  class PairFilter : public btOverlapFilterCallback {
   public:
    explicit PairFilter(int num_bodies)
        : num_bodies_(num_bodies),
          excluded_(static_cast<size_t>(num_bodies * num_bodies), false) {}
    void Exclude(int body_a, int body_b);
    bool needBroadphaseCollision(btBroadphaseProxy* a,
                                 btBroadphaseProxy* b) const override;

   private:
    int num_bodies_;
    std::vector<char> excluded_;
  };

  using Colliders = std::vector<std::unique_ptr<btMultiBodyLinkCollider>>;

  void AddGround(const PlantSettings& settings);
  void AddCollider(const PlantSettings& settings, int body,
                   btCollisionShape* shape, int group, Colliders* colliders);
  void AddColliders(const Robot& robot, const PlantSettings& settings,
                    double sole_radius);
  void AddLimits(const RobotModel& model);

  // Bullet moves only one collider per link, so the second one of each foot
  // must be moved explicitly.
  void MoveFootColliders();

  BulletBody body_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  std::unique_ptr<btMultiBodyConstraintSolver> solver_;
  PairFilter filter_;
  btMultiBodyDynamicsWorld world_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> ground_;
  Colliders colliders_;       // By body; for feet the soles.
  Colliders foot_colliders_;  // Shapes of the feet except the soles.
  std::vector<std::unique_ptr<btMultiBodyConstraint>> limits_;
  std::vector<GroundContact> contacts_;
};

}  // namespace poise
