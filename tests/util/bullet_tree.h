// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// A tree in Bullet's InverseDynamics, for comparison. Motions and forces are
/// in Poise's conventions: see Tree and ComputeRnea(). Armatures are left out.
class BulletTree {
 public:
  /// Returns whether Debian's libbullet-extras-dev was installed at build time.
  /// If not, the constructor throws. tools/setup.sh --baselines installs it.
  static bool IsHere();

  /// Throws std::runtime_error if IsHere() is false or Bullet rejects the tree.
  explicit BulletTree(const Tree& tree);
  ~BulletTree();

  /// Sets the motion for the next computation. F_Bo_W has one force per body,
  /// or is empty if there are no forces.
  void Set(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
           const Eigen::VectorXd& vdot,
           const std::vector<SpatialForce>& F_Bo_W);

  /// These two call only Bullet, so that a benchmark measures only Bullet.
  /// tau() and M() return their results.
  void ComputeInverseDynamics();
  void ComputeMassMatrix();

  Eigen::VectorXd tau() const;
  Eigen::MatrixXd M() const;

 private:
  struct Bullet;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace poise
