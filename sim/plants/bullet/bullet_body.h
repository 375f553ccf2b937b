// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"

namespace poise {

/// Convert vectors and poses from Eigen to Bullet.
btVector3 ToBullet(const Eigen::Vector3d& p);
btTransform ToBullet(const Pose& X);

/// Convert vectors and rotations from Bullet to Eigen.
Eigen::Vector3d FromBullet(const btVector3& p);
Eigen::Matrix3d FromBullet(const btQuaternion& q);

/// A tree as a btMultiBody. SetState() and GetState() convert states between
/// the conventions of the tree and of Bullet.
///
/// Bullet puts the frame L of each link at the link's center of mass, along the
/// principal axes, so that the inertia is diagonal. Body i of the tree is link
/// i - 1. Bullet's base velocity is the velocity of the base's center of mass,
/// and its base quaternion represents R_LW.
class BulletBody {
 public:
  /// Throws std::invalid_argument if a joint has armature, which Bullet's
  /// multibody cannot represent, or if a body has no mass.
  explicit BulletBody(const Tree& tree);

  btMultiBody& body() { return *body_; }
  const btMultiBody& body() const { return *body_; }

  /// Returns the pose of Bullet's link frame L in the tree's body frame B.
  const Pose& X_BL(int body) const { return X_BL_[static_cast<size_t>(body)]; }

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
