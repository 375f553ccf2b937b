// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"

namespace poise {

/// A tree as Bullet's InverseDynamics has it, for comparison. Motions and forces
/// are ours: see Tree and ComputeRnea(). Armatures are left out.
class BulletTree {
 public:
  /// Whether Debian's libbullet-extras-dev was there when this was built: only
  /// then can one be made. tools/setup.sh --baselines installs it.
  static bool IsHere();

  /// Throws std::runtime_error if IsHere() is false, or Bullet refuses the tree.
  explicit BulletTree(const Tree& tree);
  ~BulletTree();

  /// What the next computation is of. F_Bo_W is by body, or empty for none.
  void Set(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
           const Eigen::VectorXd& vdot,
           const std::vector<SpatialForce>& F_Bo_W);

  /// These two are Bullet's work alone; the results are theirs to be asked for.
  void ComputeInverseDynamics();
  void ComputeMassMatrix();

  Eigen::VectorXd tau() const;
  Eigen::MatrixXd M() const;

 private:
  struct Bullet;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace poise
