// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/bullet/bullet_world.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "poise/sim/plants/bullet/contact_solver.h"
#include "poise/sim/plants/neighbors.h"

namespace poise {

namespace {

// User index of collision objects of the ground. The user index of a link is
// the index of its body.
constexpr int kGround = -1;

// Collision group of shapes that collide with links, but not with the ground.
constexpr int kAboveGround = btBroadphaseProxy::CharacterFilter;

std::unique_ptr<btCollisionShape> MakeShape(const Geometry& geometry) {
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    return std::make_unique<btSphereShape>(sphere->radius);
  }
  if (const auto* box = std::get_if<Box>(&geometry)) {
    return std::make_unique<btBoxShape>(ToBullet(box->size / 2));
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    return std::make_unique<btCylinderShapeZ>(
        btVector3(cylinder->radius, cylinder->radius, cylinder->length / 2));
  }
  return nullptr;  // A mesh is only drawn; it does not collide.
}

bool IsGround(const btCollisionObject* object) {
  return object->getUserIndex() == kGround;
}

// Returns the mean force over a step of a manifold point on its object A, N.
btVector3 ForceOnA(const btManifoldPoint& point, double dt) {
  return (point.m_appliedImpulse * point.m_normalWorldOnB +
          point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
          point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2) /
         dt;
}

}  // namespace

void BulletWorld::PairFilter::Exclude(int body_a, int body_b) {
  excluded_[body_a * num_bodies_ + body_b] = true;
  excluded_[body_b * num_bodies_ + body_a] = true;
}

bool BulletWorld::PairFilter::needBroadphaseCollision(
    btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  // A body without a shape belongs to no group.
  if (a->m_collisionFilterGroup == 0 || b->m_collisionFilterGroup == 0) {
    return false;
  }
  const int body_a =
      static_cast<btCollisionObject*>(a->m_clientObject)->getUserIndex();
  const int body_b =
      static_cast<btCollisionObject*>(b->m_clientObject)->getUserIndex();
  if (body_a == kGround || body_b == kGround) {
    return body_a != body_b && a->m_collisionFilterGroup != kAboveGround &&
           b->m_collisionFilterGroup != kAboveGround;
  }
  return !excluded_[body_a * num_bodies_ + body_b];
}

BulletWorld::BulletWorld(const Robot& robot, const PlantSettings& settings,
                         const BulletSettings& bullet)
    : body_(robot.model.tree),
      dispatcher_(&configuration_),
      solver_(bullet.own_sweeps
                  ? std::make_unique<ContactSolver>()
                  : std::make_unique<btMultiBodyConstraintSolver>()),
      filter_(robot.model.tree.num_bodies()),
      world_(&dispatcher_, &broadphase_, solver_.get(), &configuration_) {
  world_.setGravity(ToBullet(robot.model.tree.gravity_W()));
  world_.getPairCache()->setOverlapFilterCallback(&filter_);
  btContactSolverInfo& info = world_.getSolverInfo();
  info.m_numIterations = bullet.solver_iterations;
  info.m_leastSquaresResidualThreshold = bullet.residual_threshold;
  if (settings.restitution > 0) info.m_erp2 = 0;
  if (bullet.two_friction_directions) {
    info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  } else {
    info.m_solverMode &= ~SOLVER_USE_2_FRICTION_DIRECTIONS;
  }

  btMultiBody& body = body_.body();
  body.setLinearDamping(bullet.linear_damping);
  body.setAngularDamping(bullet.angular_damping);
  body.setUseGyroTerm(bullet.gyroscopic_term);
  body.useRK4Integration(bullet.rk4);
  body.useGlobalVelocities(bullet.global_velocities);
  body.setMaxCoordinateVelocity(bullet.max_velocity);
  body.setCanSleep(bullet.can_sleep);
  body.setHasSelfCollision(settings.self_collision);
  world_.addMultiBody(&body);

  AddGround(settings);
  AddColliders(robot, settings, bullet.sole_radius);
  if (settings.joint_limits) AddLimits(robot.model);
}

BulletWorld::~BulletWorld() {
  for (const auto& limit : limits_) world_.removeMultiBodyConstraint(&*limit);
  for (const auto* colliders : {&colliders_, &foot_colliders_}) {
    for (const auto& each : *colliders) world_.removeCollisionObject(&*each);
  }
  for (const auto& object : ground_) world_.removeCollisionObject(&*object);
  world_.removeMultiBody(&body_.body());
}

void BulletWorld::AddGround(const PlantSettings& settings) {
  const auto add = [this](std::unique_ptr<btCollisionShape> shape,
                          const Pose& X_WS) {
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(shape.get());
    object->setWorldTransform(ToBullet(X_WS));
    // Bullet multiplies the coefficients of two objects, so the ground has 1.
    object->setFriction(1);
    object->setRestitution(1);
    object->setUserIndex(kGround);
    world_.addCollisionObject(object.get(), btBroadphaseProxy::StaticFilter,
                              btBroadphaseProxy::DefaultFilter);
    shapes_.push_back(std::move(shape));
    ground_.push_back(std::move(object));
  };
  const Eigen::Vector3d normal_W = GroundNormal(settings.ground);
  add(std::make_unique<btStaticPlaneShape>(ToBullet(normal_W), 0), Pose{});
  for (const Board& board : settings.ground.boards) {
    const Eigen::Matrix3d R_WS =
        Eigen::AngleAxisd(board.yaw, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    add(std::make_unique<btBoxShape>(ToBullet(board.size / 2)),
        {R_WS, board.center_W});
  }
}

void BulletWorld::AddCollider(const PlantSettings& settings, int body,
                              btCollisionShape* shape, int group,
                              Colliders* colliders) {
  auto collider =
      std::make_unique<btMultiBodyLinkCollider>(&body_.body(), body - 1);
  collider->setCollisionShape(shape);
  collider->setFriction(settings.friction);
  collider->setRestitution(settings.restitution);
  // By default Bullet stops a body just above the ground, if it would touch
  // within a step, so that it cannot bounce. With restitution a body therefore
  // penetrates first, by up to one step of motion. Bullet then must not push
  // the body out, because that would add speed: m_erp2 is 0.
  if (settings.restitution > 0) collider->setContactProcessingThreshold(0);
  collider->setUserIndex(body);
  world_.addCollisionObject(collider.get(), group,
                            group == 0 ? 0 : btBroadphaseProxy::AllFilter);
  colliders->push_back(std::move(collider));
}

void BulletWorld::AddColliders(const Robot& robot,
                               const PlantSettings& settings,
                               double sole_radius) {
  const Tree& tree = robot.model.tree;
  using Compounds = std::vector<std::unique_ptr<btCompoundShape>>;
  Compounds links(tree.num_bodies()), feet(tree.num_bodies());
  const auto add = [&](int body, const Pose& X_BS,
                       std::unique_ptr<btCollisionShape> shape,
                       Compounds* compounds) {
    auto& compound = (*compounds)[body];
    if (compound == nullptr) compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(ToBullet(body_.X_BL(body).Inverse() * X_BS),
                            shape.get());
    shapes_.push_back(std::move(shape));
  };
  std::vector<bool> is_foot(tree.num_bodies(), false);
  for (const Foot& foot : robot.feet) {
    is_foot[foot.body] = true;
    for (const Eigen::Vector2d& corner : foot.polygon_C) {
      const Pose X_CS{Eigen::Matrix3d::Identity(),
                      {corner.x(), corner.y(), sole_radius}};
      add(foot.body, foot.X_BC * X_CS,
          std::make_unique<btSphereShape>(sole_radius), &links);
    }
  }
  for (const Shape& shape : robot.model.collisions) {
    const Frame& frame = tree.frames()[shape.frame];
    // Bullet's contacts between two boxes are poor. So a foot touches the
    // ground only with the spheres of its sole. It touches other links with its
    // shapes.
    if (auto made = MakeShape(shape.geometry)) {
      add(frame.body, frame.X_BF * shape.X_FS, std::move(made),
          is_foot[frame.body] ? &feet : &links);
    }
  }

  // The filter must be complete before colliders are added. Bullet asks about a
  // pair once, when its bounding boxes first overlap. Here all colliders are
  // still at the origin and overlap.
  for (const auto& [a, b] : FindNeighbors(tree)) filter_.Exclude(a, b);
  for (int i = 0; i < tree.num_bodies(); ++i) filter_.Exclude(i, i);

  // Bullet ignores the joint limits of a link without a collider.
  auto nothing = std::make_unique<btSphereShape>(1e-3);
  for (int i = 0; i < tree.num_bodies(); ++i) {
    if (links[i] != nullptr) {
      AddCollider(settings, i, links[i].get(), btBroadphaseProxy::DefaultFilter,
                  &colliders_);
    } else {
      AddCollider(settings, i, nothing.get(), /* group */ 0, &colliders_);
    }
    if (i == 0) {
      body_.body().setBaseCollider(colliders_[i].get());
    } else {
      body_.body().getLink(i - 1).m_collider = colliders_[i].get();
    }
  }
  for (int i = 0; i < tree.num_bodies(); ++i) {
    if (feet[i] == nullptr) continue;
    AddCollider(settings, i, feet[i].get(), kAboveGround, &foot_colliders_);
  }
  for (Compounds* compounds : {&links, &feet}) {
    for (auto& compound : *compounds) {
      if (compound != nullptr) shapes_.push_back(std::move(compound));
    }
  }
  shapes_.push_back(std::move(nothing));
}

void BulletWorld::MoveFootColliders() {
  for (const auto& collider : foot_colliders_) {
    const auto& link = colliders_[collider->getUserIndex()];
    collider->setWorldTransform(link->getWorldTransform());
  }
}

void BulletWorld::AddLimits(const RobotModel& model) {
  for (int j = 0; j < model.tree.num_joints(); ++j) {
    const JointLimits& limits = model.limits[j];
    if (!std::isfinite(limits.lower) && !std::isfinite(limits.upper)) continue;
    limits_.push_back(std::make_unique<btMultiBodyJointLimitConstraint>(
        &body_.body(), j, limits.lower, limits.upper));
    world_.addMultiBodyConstraint(limits_.back().get());
  }
}

void BulletWorld::Place() {
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body_.body().forwardKinematics(rotations, origins);
  body_.body().updateCollisionObjectWorldTransforms(rotations, origins);
  MoveFootColliders();

  world_.performDiscreteCollisionDetection();
  for (int i = dispatcher_.getNumManifolds() - 1; i >= 0; --i) {
    const btPersistentManifold* pair =
        dispatcher_.getManifoldByIndexInternal(i);
    if (IsGround(pair->getBody0()) || IsGround(pair->getBody1())) continue;
    bool touches = false;
    for (int k = 0; k < pair->getNumContacts(); ++k) {
      touches = touches || pair->getContactPoint(k).getDistance() <= 0;
    }
    if (!touches) continue;
    filter_.Exclude(pair->getBody0()->getUserIndex(),
                    pair->getBody1()->getUserIndex());
  }
  // Removes the pairs that are now excluded from Bullet's cache.
  btBroadphasePairArray pairs =
      world_.getPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    btBroadphaseProxy *a = pairs[i].m_pProxy0, *b = pairs[i].m_pProxy1;
    if (filter_.needBroadphaseCollision(a, b)) continue;
    world_.getPairCache()->removeOverlappingPair(a, b, &dispatcher_);
  }
}

const std::vector<GroundContact>& BulletWorld::FindGroundContacts(double dt) {
  contacts_.clear();
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold* pair =
        dispatcher_.getManifoldByIndexInternal(i);
    const bool robot_is_a = IsGround(pair->getBody1());
    if (!robot_is_a && !IsGround(pair->getBody0())) continue;
    const int body =
        (robot_is_a ? pair->getBody0() : pair->getBody1())->getUserIndex();
    for (int k = 0; k < pair->getNumContacts(); ++k) {
      const btManifoldPoint& point = pair->getContactPoint(k);
      if (point.m_appliedImpulse <= 0) continue;
      const Eigen::Vector3d force_A_W = FromBullet(ForceOnA(point, dt));
      contacts_.push_back(
          {body,
           FromBullet(robot_is_a ? point.getPositionWorldOnA()
                                 : point.getPositionWorldOnB()),
           robot_is_a ? force_A_W : Eigen::Vector3d(-force_A_W)});
    }
  }
  return contacts_;
}

void BulletWorld::FindSelfContacts(std::vector<std::pair<int, int>>* pairs) {
  pairs->clear();
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold* pair =
        dispatcher_.getManifoldByIndexInternal(i);
    if (IsGround(pair->getBody0()) || IsGround(pair->getBody1())) continue;
    for (int k = 0; k < pair->getNumContacts(); ++k) {
      if (pair->getContactPoint(k).m_appliedImpulse <= 0) continue;
      pairs->emplace_back(std::minmax(pair->getBody0()->getUserIndex(),
                                      pair->getBody1()->getUserIndex()));
      break;
    }
  }
  // A foot has two colliders, its sole and its shapes, so a pair can occur
  // twice.
  std::sort(pairs->begin(), pairs->end());
  pairs->erase(std::unique(pairs->begin(), pairs->end()), pairs->end());
}

}  // namespace poise
