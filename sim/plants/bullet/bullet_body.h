// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"

namespace poise {

/// Converts vectors, rotations and poses to Bullet's types.
btVector3 ToBullet(const Eigen::Vector3d& p);
btTransform ToBullet(const Pose& X);

/// Converts Bullet's types back.
Eigen::Vector3d FromBullet(const btVector3& p);
Eigen::Matrix3d FromBullet(const btQuaternion& q);

/// A tree as a btMultiBody. One function in each direction converts between the two
/// conventions.
///
/// Bullet puts the frame L of each link at its center of mass, along its
/// principal axes, so that its inertia is diagonal; body i of the tree is link
/// i - 1. Its base velocity is that of the base's center of mass, its base
/// quaternion that of R_LW.
class BulletBody {
 public:
  /// Throws std::invalid_argument if a joint has armature, which Bullet's
  /// multibody cannot represent, or a body no mass.
  explicit BulletBody(const Tree& tree);

  btMultiBody& body() { return *body_; }
  const btMultiBody& body() const { return *body_; }

  /// Returns Bullet's link frame in the tree's body.
  const Pose& X_BL(int body) const { return X_BL_[body]; }

  void SetState(const Eigen::VectorXd& q, const Eigen::VectorXd& v);

  /// Fills q and v, of sizes nq and nv.
  void GetState(Eigen::VectorXd* q, Eigen::VectorXd* v) const;

 private:
  bool floating_;
  int num_joints_;
  std::vector<Pose> X_BL_;
  std::unique_ptr<btMultiBody> body_;
};

}  // namespace poise
