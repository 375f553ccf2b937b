// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares the dynamics with MuJoCo on random trees, through the conversions of
// dynamics/conventions.h.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "poise/dynamics/center_of_mass.h"
#include "poise/dynamics/conventions.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/sim/plants/mujoco/load_mujoco.h"
#include "poise/sim/plants/mujoco/mujoco_model.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajorXd =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr Library kMujoco = Library::kMujoco;

// MuJoCo keeps an inertia as principal moments and axes, which it finds by an
// iteration that leaves relative errors of 1e-7. The torques are below 100 N m.
constexpr double kPrincipal = 1e-5;

// Returns the tree as MuJoCo's XML without the memory for contacts, which takes
// MuJoCo 0.3 s to clear.
std::string XmlOf(const Tree& tree) {
  std::string xml = MakeMujocoXml(MakeRobot(tree), {}, {});
  const size_t size = xml.find("<size ");
  EXPECT_NE(size, std::string::npos);
  return xml.erase(size, xml.find("/>", size) + 2 - size);
}

// A random tree in MuJoCo, in the same state as here.
struct Case {
  Case(int seed, BaseType base)
      : draw(static_cast<unsigned>(seed)),
        tree(MakeRandomTree(1 + seed % 12, &draw, base, {1, -2, -9})),
        q(MakeRandomConfiguration(tree, &draw)),
        v(MakeRandomVector(tree.nv(), &draw)),
        model(LoadMujoco(XmlOf(tree), &error)),
        data(model ? mj_makeData(model.get()) : nullptr) {
    if (!data) return;
    ExportConfiguration(kMujoco, tree, q, Positions());
    ExportVelocity(kMujoco, tree, q, v,
                   Eigen::Map<VectorXd>(data->qvel, model->nv));
    mj_forward(model.get(), data.get());
  }

  Eigen::Map<VectorXd> Positions() const { return {data->qpos, model->nq}; }
  // Rounding errors of numbers below 100, which are positions in m and rows of
  // Jacobians.
  double tolerance() const { return Rounding(100, tree.nv() + 10); }

  std::mt19937 draw;
  Tree tree;
  VectorXd q, v;
  std::string error;
  MujocoModel model;
  MujocoData data;
};

void ForRandomTrees(const std::function<void(const Case&)>& check) {
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case each(seed, seed % 4 ? BaseType::kFloating : BaseType::kFixed);
    ASSERT_TRUE(each.model) << each.error;
    ASSERT_EQ(each.model->nq, ConfigurationSize(kMujoco, each.tree));
    ASSERT_EQ(each.model->nv, each.tree.nv());
    check(each);
  }
}

MatrixXd MassMatrixOf(const Case& c) {
  Recursion scratch(c.tree);
  MatrixXd M(c.tree.nv(), c.tree.nv());
  ComputeCrba(c.tree, c.q, &scratch, M);
  return M;
}

TEST(WithMujoco, MassMatrixAgrees) {
  ForRandomTrees([](const Case& c) {
    const int n = c.tree.nv();
    RowMajorXd theirs(n, n);
    mj_fullM(c.model.get(), theirs.data(), c.data->qM);
    const MatrixXd ours = MassMatrixOf(c);
    MatrixXd exported(n, n), imported(n, n);
    ExportMassMatrix(kMujoco, c.tree, c.q, ours, exported);
    ImportMassMatrix(kMujoco, c.tree, c.q, MatrixXd(theirs), imported);
    EXPECT_LT((exported - theirs).norm(), kPrincipal);
    EXPECT_LT((imported - ours).norm(), kPrincipal);
  });
}

TEST(WithMujoco, BiasAgrees) {
  ForRandomTrees([](const Case& c) {
    const int n = c.tree.nv();
    const MatrixXd M = MassMatrixOf(c);
    Recursion scratch(c.tree);
    VectorXd ours(n), exported(n), imported(n);
    ComputeBias(c.tree, c.q, c.v, &scratch, ours);
    const Eigen::Map<const VectorXd> theirs(c.data->qfrc_bias, n);
    ExportBias(kMujoco, c.tree, c.q, c.v, M, ours, exported);
    ImportBias(kMujoco, c.tree, c.q, c.v, M, theirs, imported);
    EXPECT_LT((exported - theirs).norm(), kPrincipal);
    EXPECT_LT((imported - ours).norm(), kPrincipal);
  });
}

TEST(WithMujoco, BodyJacobianAgrees) {
  ForRandomTrees([](const Case& c) {
    const int n = c.tree.nv();
    std::vector<Pose> X_WB(c.tree.num_bodies());
    ComputePoses(c.tree, c.q, &X_WB);
    for (size_t f = 0; f < c.tree.frames().size(); ++f) {
      // Each frame of these trees is the own frame of a body.
      RowMajorXd theirs(6, n);
      mj_jacBody(c.model.get(), c.data.get(), theirs.data(),
                 theirs.data() + 3 * n, c.tree.frames()[f].body + 1);
      Matrix6Xd ours(6, n), exported(6, n), imported(6, n);
      ComputeFrameJacobian(c.tree, X_WB, static_cast<int>(f), Axes::kWorld,
                           ours);
      ExportJacobian(kMujoco, c.tree, c.q, ours, exported);
      ImportJacobian(kMujoco, c.tree, c.q, Matrix6Xd(theirs), imported);
      EXPECT_LT((exported - theirs).norm(), c.tolerance());
      EXPECT_LT((imported - ours).norm(), c.tolerance());
    }
  });
}

TEST(WithMujoco, ForwardDynamicsAgrees) {
  // No force acts but gravity, so RNEA at MuJoCo's acceleration must give zero.
  ForRandomTrees([](const Case& c) {
    const int n = c.tree.nv();
    const Eigen::Map<const VectorXd> qacc(c.data->qacc_smooth, n);
    VectorXd vdot(n), tau(n);
    ImportAcceleration(kMujoco, c.tree, c.q, c.v, qacc, vdot);
    Recursion scratch(c.tree);
    ComputeRnea(c.tree, c.q, c.v, vdot, {}, &scratch, tau);
    EXPECT_LT(tau.norm(), kPrincipal);
  });
}

TEST(WithMujoco, IntegrationAgrees) {
  ForRandomTrees([](const Case& c) {
    const double dt = 0.3;  // s; a rotation of the base by up to 30 degrees.
    VectorXd ours(c.tree.nq()), theirs(c.Positions());
    VectorXd exported(theirs.size());
    Integrate(c.tree, c.q, c.v, dt, ours);
    mj_integratePos(c.model.get(), theirs.data(), c.data->qvel, dt);
    ExportConfiguration(kMujoco, c.tree, ours, exported);
    EXPECT_LT((exported - theirs).norm(), c.tolerance());
  });
}

TEST(WithMujoco, CenterOfMassAgrees) {
  // A fixed base is part of MuJoCo's world, and its mass does not count there.
  ForRandomTrees([](const Case& c) {
    if (!c.tree.is_floating()) return;
    Recursion scratch(c.tree);
    CenterOfMass com(c.tree);
    ComputeCenterOfMass(c.tree, c.q, c.v, &scratch, &com);
    const Eigen::Map<const Eigen::Vector3d> theirs(c.data->subtree_com + 3);
    EXPECT_LT((com.p_WG - theirs).norm(), c.tolerance());
  });
}

}  // namespace
}  // namespace poise
