// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares inverse dynamics and the mass matrix with Bullet's InverseDynamics
// on random trees. The tests are skipped if Bullet's library is not installed.

#include <gtest/gtest.h>

#include <functional>

#include "poise/dynamics/crba.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/bullet_tree.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Compares Poise and Bullet on random motions. Bullet has no armatures, so
// `compare` receives them and adds their effect.
bool AgreesWithBullet(
    const char* what,
    const std::function<Residual(const TreeMotion&, const VectorXd& armatures,
                                 BulletTree*)>& compare) {
  return HoldsForTrees(what, [&compare](const TreeMotion& m) {
    VectorXd armatures = VectorXd::Zero(m.tree.nv());
    for (int j = 0; j < m.tree.num_joints(); ++j) {
      armatures[m.tree.v_start() + j] = m.tree.joints()[j].armature;
    }
    BulletTree bullet(m.tree);
    bullet.Set(m.q, m.v, m.vdot, m.F_Bo_W);
    return compare(m, armatures, &bullet);
  });
}

class WithBullet : public testing::Test {
 protected:
  void SetUp() override {
    if (!BulletTree::IsHere()) {
      GTEST_SKIP() << "libbullet-extras-dev is not installed: run "
                      "tools/setup.sh --baselines";
    }
  }
};

TEST_F(WithBullet, RneaAgrees) {
  EXPECT_TRUE(AgreesWithBullet(
      "tau",
      [](const TreeMotion& m, const VectorXd& armatures, BulletTree* bullet) {
        Recursion scratch(m.tree);
        VectorXd tau(m.tree.nv());
        ComputeRnea(m.tree, m.q, m.v, m.vdot, m.F_Bo_W, &scratch, tau);
        bullet->ComputeInverseDynamics();
        return Compare(tau, bullet->tau() + armatures.cwiseProduct(m.vdot),
                       Rounding(1000 + 10 * tau.norm(), m.tree.nv() + 10));
      }));
}

TEST_F(WithBullet, CrbaAgrees) {
  EXPECT_TRUE(AgreesWithBullet("M", [](const TreeMotion& m,
                                       const VectorXd& armatures,
                                       BulletTree* bullet) {
    Recursion scratch(m.tree);
    MatrixXd M(m.tree.nv(), m.tree.nv());
    ComputeCrba(m.tree, m.q, &scratch, M);
    bullet->ComputeMassMatrix();
    MatrixXd theirs = bullet->M();
    theirs.diagonal() += armatures;
    return Compare(M, theirs, Rounding(1000 + 10 * M.norm(), m.tree.nv() + 10));
  }));
}

}  // namespace
}  // namespace poise
