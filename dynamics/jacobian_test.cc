// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/jacobian.h"

#include <gtest/gtest.h>

#include "poise/dynamics/integrate.h"
#include "poise/dynamics/kinematics.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/ridders.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::VectorXd;

// The last frame of a tree in a motion.
struct LastFrame {
  explicit LastFrame(const TreeMotion& m) : LastFrame(m.tree, m.q, m.v) {}
  LastFrame(const Tree& tree, const VectorXd& q, const VectorXd& v)
      : frame(static_cast<int>(tree.frames().size()) - 1),
        X_WB(tree.num_bodies()),
        V_WB_W(tree.num_bodies()),
        A_WB_W(tree.num_bodies()) {
    ComputePoses(tree, q, &X_WB);
    ComputeVelocities(tree, X_WB, v, &V_WB_W);
    ComputeAccelerations(tree, X_WB, V_WB_W, v, VectorXd::Zero(tree.nv()),
                         &A_WB_W);
    X_WF = FramePose(tree, X_WB, frame);
    V_WF_W = FrameVelocity(tree, X_WB, V_WB_W, frame);
    A_WF_W = FrameAcceleration(tree, X_WB, V_WB_W, A_WB_W, frame);
  }

  Matrix6Xd Jacobian(const Tree& tree, Axes axes) const {
    // The function must overwrite old values.
    Matrix6Xd J = Matrix6Xd::Constant(6, tree.nv(), 7);
    ComputeFrameJacobian(tree, X_WB, frame, axes, J);
    return J;
  }

  Vector6d Velocity(Axes axes) const {
    const Eigen::Matrix3d R_FW = X_WF.R.transpose();
    return (axes == Axes::kFrame ? R_FW * V_WF_W : V_WF_W).vector();
  }

  int frame;
  std::vector<Pose> X_WB;
  std::vector<SpatialMotion> V_WB_W;
  std::vector<SpatialAcceleration> A_WB_W;
  Pose X_WF;
  SpatialMotion V_WF_W;
  SpatialAcceleration A_WF_W;
};

TEST(FrameJacobian, TimesVIsTheVelocity) {
  for (const Axes axes : {Axes::kWorld, Axes::kFrame}) {
    EXPECT_TRUE(HoldsForTrees("J v = V", [axes](const TreeMotion& m) {
      const LastFrame F(m);
      const Matrix6Xd J = F.Jacobian(m.tree, axes);
      return Compare(J * m.v, F.Velocity(axes),
                     Rounding(10 + J.norm() * m.v.norm(), m.tree.nv() + 6));
    }));
  }
}

TEST(FrameJacobian, HasNoOtherColumns) {
  // Compares columns by unit velocities.
  EXPECT_TRUE(HoldsForTrees("J e = V", [](const TreeMotion& m) {
    Matrix6Xd velocities(6, m.tree.nv());
    for (int j = 0; j < m.tree.nv(); ++j) {
      velocities.col(j) = LastFrame(m.tree, m.q, VectorXd::Unit(m.tree.nv(), j))
                              .V_WF_W.vector();
    }
    const Matrix6Xd J = LastFrame(m).Jacobian(m.tree, Axes::kWorld);
    return Compare(J, velocities, Rounding(10, m.tree.nv() + 6));
  }));
}

TEST(FrameBias, IsTheRateAtConstantV) {
  for (const Axes axes : {Axes::kWorld, Axes::kFrame}) {
    EXPECT_TRUE(HoldsForTrees("J̇ v", [axes](const TreeMotion& m) {
      const LastFrame F(m);
      const VectorXd rate = RiddersRate([&](double t) {
        VectorXd q(m.tree.nq());
        Integrate(m.tree, m.q, m.v, t, q);
        return LastFrame(m.tree, q, m.v).Velocity(axes);
      });
      const Vector6d bias = FrameBias(F.A_WF_W, F.V_WF_W, F.X_WF.R, axes);
      return Compare(bias, rate, kRiddersPrecision * (100 + bias.norm()));
    }));
  }
}

TEST(FrameJacobian, DoesNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kChain, BaseType::kFloating, 12, 1});
  const LastFrame F(m);
  Matrix6Xd J(6, m.tree.nv());
  CountMalloc count;
  ComputeFrameJacobian(m.tree, F.X_WB, F.frame, Axes::kWorld, J);
  ComputeFrameJacobian(m.tree, F.X_WB, F.frame, Axes::kFrame, J);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
