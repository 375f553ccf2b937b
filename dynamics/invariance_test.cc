// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Tests that results do not depend on the description of a robot, and
// conservation laws.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>
#include <random>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/energy.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/dynamics/tick.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A robot with body `root` as its base. A joint between the old and the new
// base is reversed: its child becomes the parent, its axis points the other
// way, and the origin of the body that was the parent moves to it.
struct Rerooted {
  Rerooted(const Tree& from, int root)
      : X_NB(from.num_bodies()), tree(Build(from, root)) {
    for (const Joint& joint : from.joints()) {
      order.push_back(*tree.FindJoint(joint.name));
    }
  }

  std::vector<Pose> X_NB;  // By body: its old frame in its new frame.
  Tree tree;
  std::vector<int> order;  // New number of each old joint.

 private:
  Tree Build(const Tree& from, int root) {
    std::vector<bool> is_turned(from.num_bodies(), false);
    for (int b = root; b > 0; b = from.joints()[b - 1].parent) {
      const Joint& joint = from.joints()[b - 1];
      is_turned[b] = true;
      X_NB[joint.parent] = joint.X_PF.Inverse();
    }
    TreeBuilder builder;
    builder.SetGravity(from.gravity_W());
    for (int b = 0; b < from.num_bodies(); ++b) {
      builder.AddLink(std::to_string(b), X_NB[b] * from.inertias()[b]);
    }
    for (int b = 1; b < from.num_bodies(); ++b) {
      const Joint& joint = from.joints()[b - 1];
      const bool turned = is_turned[b];
      JointSpec spec;
      spec.name = joint.name;
      spec.type = joint.type;
      spec.armature = joint.armature;
      spec.parent = std::to_string(turned ? b : joint.parent);
      spec.child = std::to_string(turned ? joint.parent : b);
      spec.X_PF = turned ? X_NB[b] : X_NB[joint.parent] * joint.X_PF;
      spec.axis_F = turned ? -joint.axis_F : joint.axis_F;
      builder.AddJoint(spec);
    }
    return builder.Build();
  }
};

// Returns the accelerations of the bodies' origins at v̇.
std::vector<SpatialAcceleration> AccelerationsOf(const TreeMotion& m,
                                                 const VectorXd& vdot) {
  std::vector<Pose> X_WB(m.tree.num_bodies());
  std::vector<SpatialMotion> V_WB_W(X_WB.size());
  std::vector<SpatialAcceleration> A_WB_W(X_WB.size());
  ComputePoses(m.tree, m.q, &X_WB);
  ComputeVelocities(m.tree, X_WB, m.v, &V_WB_W);
  ComputeAccelerations(m.tree, X_WB, V_WB_W, m.v, vdot, &A_WB_W);
  return A_WB_W;
}

// Returns the state of the robot with another body as base.
TreeMotion Move(const TreeMotion& m, int root, const Rerooted& rerooted) {
  std::vector<Pose> X_WB(m.tree.num_bodies());
  std::vector<SpatialMotion> V_WB_W(X_WB.size());
  ComputePoses(m.tree, m.q, &X_WB);
  ComputeVelocities(m.tree, X_WB, m.v, &V_WB_W);
  TreeMotion moved{rerooted.tree, m.q, m.v, m.vdot, {}};
  moved.q.head<3>() = X_WB[root].p;
  moved.q.segment<4>(3) = Eigen::Quaterniond(X_WB[root].R).coeffs();
  moved.v.head<6>() = V_WB_W[root].vector();
  moved.vdot.head<6>() = AccelerationsOf(m, m.vdot)[root].vector();
  for (int j = 0; j < m.tree.num_joints(); ++j) {
    moved.q[7 + rerooted.order[j]] = m.q[7 + j];
    moved.v[6 + rerooted.order[j]] = m.v[6 + j];
    moved.vdot[6 + rerooted.order[j]] = m.vdot[6 + j];
  }
  return moved;
}

int LastBody(const TreeMotion& m) { return m.tree.num_bodies() - 1; }

Tick TickOf(const TreeMotion& m) {
  Tick tick(m.tree, {});
  ComputeTick(m.tree, m.q, m.v, &tick);
  return tick;
}

TEST(Dynamics, OfTheRobotDoesNotDependOnTheRoot) {
  EXPECT_TRUE(HoldsForTrees(
      "p_WG, v_WG, L_G and its rate, energy", [](const TreeMotion& m) {
        if (!m.tree.is_floating()) return Residual{0, 0};
        const Rerooted rerooted(m.tree, LastBody(m));
        const TreeMotion moved = Move(m, LastBody(m), rerooted);
        MatrixXd numbers(19, 2);
        for (const TreeMotion* motion : {&m, &moved}) {
          const Tick tick = TickOf(*motion);
          numbers.col(motion == &m ? 0 : 1) << tick.p_WG, tick.v_WG, tick.L_G,
              tick.H_G * motion->vdot + tick.H_G_bias,
              motion->v.dot(tick.M * motion->v) / 2;
        }
        return Compare(numbers.col(0), numbers.col(1),
                       Rounding(300 + numbers.norm(), m.tree.nv() + 10));
      }));
}

TEST(Dynamics, OfTheJointsDoesNotDependOnTheRoot) {
  // No wrench acts on either base, so the joints' torques are the same.
  EXPECT_TRUE(HoldsForTrees("v̇ of the joints", [](const TreeMotion& m) {
    if (!m.tree.is_floating()) return Residual{0, 0};
    const Rerooted rerooted(m.tree, LastBody(m));
    const TreeMotion moved = Move(m, LastBody(m), rerooted);
    const int n = m.tree.num_joints();
    VectorXd tau = VectorXd::Zero(m.tree.nv()), tau_moved = tau;
    VectorXd vdot = tau, vdot_moved = tau;
    tau.tail(n) = 10 * m.vdot.tail(n);
    for (int j = 0; j < n; ++j) tau_moved[6 + rerooted.order[j]] = tau[6 + j];
    AbaScratch scratch(m.tree), scratch_moved(moved.tree);
    if (ComputeAba(m.tree, m.q, m.v, tau, {}, &scratch, vdot) !=
            AbaStatus::kOk ||
        ComputeAba(moved.tree, moved.q, moved.v, tau_moved, {}, &scratch_moved,
                   vdot_moved) != AbaStatus::kOk) {
      return Residual{1, 0};
    }
    VectorXd expected = vdot_moved;
    expected.head<6>() = AccelerationsOf(m, vdot)[LastBody(m)].vector();
    for (int j = 0; j < n; ++j) expected[6 + rerooted.order[j]] = vdot[6 + j];
    const Tick tick = TickOf(m), tick_moved = TickOf(moved);
    const double least =
        std::min(Eigenvalues(tick.M)[0], Eigenvalues(tick_moved.M)[0]);
    const double scale = 100 + tau.norm() + tick.N.norm() +
                         tick.M.norm() * vdot.norm() + tick_moved.N.norm() +
                         tick_moved.M.norm() * vdot_moved.norm();
    return Compare(vdot_moved, expected,
                   Rounding(scale, m.tree.nv() + 10) / least);
  }));
}

// A robot whose links and joints the builder received in another order.
struct Renumbered {
  Renumbered(const Tree& from, std::mt19937* draw) : tree(Build(from, draw)) {
    // Place of each entry of the old v in the new one.
    const int v0 = from.v_start();
    Eigen::VectorXi places(from.nv());
    for (int i = 0; i < v0; ++i) places[i] = i;
    for (int j = 0; j < from.num_joints(); ++j) {
      places[v0 + j] = v0 + *tree.FindJoint(from.joints()[j].name);
    }
    P = Eigen::PermutationMatrix<Eigen::Dynamic>(places);
  }

  Tree tree;
  Eigen::PermutationMatrix<Eigen::Dynamic> P;  // New v = P v.

 private:
  static Tree Build(const Tree& from, std::mt19937* draw) {
    std::vector<int> bodies(from.num_bodies());
    std::iota(bodies.begin(), bodies.end(), 0);
    for (size_t i = bodies.size() - 1; i > 0; --i) {
      std::swap(bodies[i], bodies[(*draw)() % (i + 1)]);
    }
    TreeBuilder builder;
    builder.SetGravity(from.gravity_W());
    for (const int b : bodies) {
      builder.AddLink(std::to_string(b), from.inertias()[b]);
      if (b == 0) continue;
      const Joint& joint = from.joints()[b - 1];
      builder.AddJoint({joint.name, joint.type, std::to_string(joint.parent),
                        std::to_string(b), joint.X_PF, joint.axis_F,
                        joint.armature});
    }
    return builder.Build(from.is_floating() ? BaseType::kFloating
                                            : BaseType::kFixed);
  }
};

TEST(Dynamics, DoesNotDependOnTheOrderOfJoints) {
  EXPECT_TRUE(HoldsForTrees("M, N, H_G, p_WG, v̇", [](const TreeMotion& m) {
    std::mt19937 draw(static_cast<unsigned>(m.tree.nv()));
    const Renumbered other(m.tree, &draw);
    const int nv = m.tree.nv(), v0 = m.tree.v_start();
    TreeMotion moved{other.tree, m.q, other.P * m.v, other.P * m.vdot, {}};
    const VectorXd joints = m.q.tail(m.tree.num_joints());
    for (int j = 0; j < m.tree.num_joints(); ++j) {
      moved.q[m.tree.q_start() + other.P.indices()[v0 + j] - v0] = joints[j];
    }
    const Tick tick = TickOf(m), tick_moved = TickOf(moved);
    MatrixXd ours(nv + 13, nv + 1), expected = ours;
    ours << tick_moved.M, tick_moved.N,       //
        tick_moved.H_G, tick_moved.H_G_bias,  //
        tick_moved.H_G, tick_moved.L_G,       //
        VectorXd::Zero(nv).transpose(), tick_moved.p_WG.sum();
    expected << other.P * tick.M * other.P.transpose(), other.P * tick.N,
        tick.H_G * other.P.transpose(), tick.H_G_bias,
        tick.H_G * other.P.transpose(), tick.L_G,
        VectorXd::Zero(nv).transpose(), tick.p_WG.sum();
    return Compare(ours, expected, Rounding(100 + ours.norm(), nv + 10));
  }));
}

// A base that floats, but rests at the world's origin, leaves the joints with
// the dynamics on a fixed base.
TEST(Dynamics, FixedBaseIsAFloatingOneAtRest) {
  EXPECT_TRUE(HoldsForTrees("M, N", [](const TreeMotion& m) {
    const int n = m.tree.num_joints();
    const VectorXd q = m.q.tail(n), v = m.v.tail(n);
    TreeMotion floating{m.tree.WithBase(BaseType::kFloating), {}, {}, {}, {}};
    floating.q = floating.tree.MakeNeutral();
    floating.v = VectorXd::Zero(floating.tree.nv());
    floating.q.tail(n) = q;
    floating.v.tail(n) = v;
    const Tick on_floating = TickOf(floating);
    const Tick on_fixed =
        TickOf({m.tree.WithBase(BaseType::kFixed), q, v, {}, {}});
    MatrixXd ours(n, n + 1), expected = ours;
    ours << on_fixed.M, on_fixed.N;
    expected << on_floating.M.bottomRightCorner(n, n), on_floating.N.tail(n);
    return Compare(ours, expected, Rounding(100 + ours.norm(), n + 10));
  }));
}

// Returns the robot in a world that is rotated by R, with its gravity. Frame b
// is that of body b.
TreeMotion Turn(const TreeMotion& m, const Matrix3d& R) {
  TreeBuilder builder;
  builder.SetGravity(R * m.tree.gravity_W());
  builder.AddLink("0", m.tree.inertias()[0]);
  for (int b = 1; b < m.tree.num_bodies(); ++b) {
    const Joint& joint = m.tree.joints()[b - 1];
    builder.AddLink(std::to_string(b), m.tree.inertias()[b]);
    builder.AddJoint({joint.name, joint.type, std::to_string(joint.parent),
                      std::to_string(b), joint.X_PF, joint.axis_F,
                      joint.armature});
  }
  TreeMotion turned{builder.Build(), m.q, m.v, m.vdot, m.F_Bo_W};
  turned.q.head<3>() = R * m.q.head<3>();
  turned.q.segment<4>(3) = (Eigen::Quaterniond(R) *
                            Eigen::Quaterniond(m.q[6], m.q[3], m.q[4], m.q[5]))
                               .coeffs();
  for (VectorXd* x : {&turned.v, &turned.vdot}) {
    x->head<3>() = (R * x->head<3>()).eval();
    x->segment<3>(3) = (R * x->segment<3>(3)).eval();
  }
  for (SpatialForce& F : turned.F_Bo_W) F = R * F;
  return turned;
}

TEST(Dynamics, RotatesWithTheWorld) {
  EXPECT_TRUE(HoldsForTrees("M, N, J, L_G, bias, tau", [](const TreeMotion& m) {
    if (!m.tree.is_floating()) return Residual{0, 0};
    const Matrix3d R =
        Eigen::AngleAxisd(1.1, Vector3d(2, -1, 2) / 3).toRotationMatrix();
    const TreeMotion turned = Turn(m, R);
    const int nv = m.tree.nv(), last = LastBody(m);
    MatrixXd T = MatrixXd::Identity(nv, nv);
    T.block<3, 3>(0, 0) = T.block<3, 3>(3, 3) = R;
    const Eigen::MatrixXd T_6 = T.topLeftCorner<6, 6>();
    // All numbers that must be equal; those of the rotated robot are rotated
    // back.
    const auto numbers_of = [last, nv](const TreeMotion& motion,
                                       const MatrixXd& T_v,
                                       const MatrixXd& T_x) {
      Tick tick(motion.tree, {last});
      ComputeTick(motion.tree, motion.q, motion.v, &tick);
      Recursion scratch(motion.tree);
      VectorXd tau(nv);
      ComputeRnea(motion.tree, motion.q, motion.v, motion.vdot, motion.F_Bo_W,
                  &scratch, tau);
      const Matrix3d R_x = T_x.topLeftCorner<3, 3>();
      MatrixXd numbers = MatrixXd::Zero(nv + 12, nv + 3);
      numbers.topLeftCorner(nv, nv) = T_v.transpose() * tick.M * T_v;
      numbers.col(nv).head(nv) = T_v.transpose() * tick.N;
      numbers.col(nv + 1).head(nv) = T_v.transpose() * tau;
      numbers.col(nv + 2).head<3>() = R_x.transpose() * tick.p_WG;
      numbers.block(nv, 0, 6, nv) = T_x.transpose() * tick.H_G * T_v;
      numbers.block<6, 1>(nv, nv) = T_x.transpose() * tick.L_G;
      numbers.block<6, 1>(nv, nv + 1) = T_x.transpose() * tick.H_G_bias;
      const FrameTick& frame = tick.frames[0];
      numbers.block(nv + 6, 0, 6, nv) = T_x.transpose() * frame.J_WF_W * T_v;
      numbers.block<6, 1>(nv + 6, nv) = T_x.transpose() * frame.Jdot_v;
      return numbers;
    };
    const MatrixXd ours = numbers_of(turned, T, T_6);
    const MatrixXd expected =
        numbers_of(Turn(m, Matrix3d::Identity()), MatrixXd::Identity(nv, nv),
                   MatrixXd::Identity(6, 6));
    return Compare(ours, expected, Rounding(100 + ours.norm(), nv + 10));
  }));
}

// Returns the invariants of free fall: [angular part of L_G; p_WG and v_WG
// minus the fall; energy].
VectorXd KeptOf(const TreeMotion& m, double time) {
  std::vector<Pose> X_WB(m.tree.num_bodies());
  ComputePoses(m.tree, m.q, &X_WB);
  const Tick tick = TickOf(m);
  const Vector3d g = m.tree.gravity_W();
  VectorXd kept(10);
  kept << tick.L_G.head<3>(), tick.v_WG - g * time,
      tick.p_WG - tick.v_WG * time + g * (time * time / 2),
      m.v.dot(tick.M * m.v) / 2 + PotentialEnergy(m.tree, X_WB);
  return kept;
}

// Returns the largest change of the invariants over half a second, integrated
// by the midpoint rule.
double DriftOf(TreeMotion m, int steps) {
  const double dt = 0.5 / steps;
  const VectorXd zero = VectorXd::Zero(m.tree.nv());
  const VectorXd before = KeptOf(m, 0);
  AbaScratch scratch(m.tree);
  VectorXd vdot = zero, v_mid = zero, q_mid = m.q;
  for (int i = 0; i < steps; ++i) {
    EXPECT_EQ(ComputeAba(m.tree, m.q, m.v, zero, {}, &scratch, vdot),
              AbaStatus::kOk);
    v_mid = m.v + dt / 2 * vdot;
    Integrate(m.tree, m.q, m.v, dt / 2, q_mid);
    EXPECT_EQ(ComputeAba(m.tree, q_mid, v_mid, zero, {}, &scratch, vdot),
              AbaStatus::kOk);
    Integrate(m.tree, m.q, v_mid, dt, m.q);
    m.v += dt * vdot;
  }
  return (KeptOf(m, 0.5) - before).cwiseAbs().maxCoeff();
}

TEST(Dynamics, ConservesMomentumInFreeFall) {
  for (const int seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    const TreeMotion m =
        MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 6, seed});
    ASSERT_GT(TickOf(m).L_G.head<3>().norm(), 0.1);
    // The rule has second order. With rates up to 10/s, a step dt of 2.5e-4 s
    // gives a drift of at most 100 dt^2, and half the step a quarter of that,
    // up to a relative error of 10 dt from the third order.
    const double coarse = DriftOf(m, 1000), fine = DriftOf(m, 2000);
    EXPECT_LT(fine, 1e-5);
    EXPECT_NEAR(coarse / fine, 4, 0.01);
  }
}

}  // namespace
}  // namespace poise
