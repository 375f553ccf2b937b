// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Checks the conversions by laws that hold in any coordinates: velocity is the
// rate of the configuration in each library's own parametrisation, kinetic
// energy and power are invariant, and the equation of motion holds.
#include "poise/dynamics/conventions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/ridders.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Library kLibraries[] = {Library::kPinocchio, Library::kDrake,
                                  Library::kMujoco};

// Checks a property on random trees for each library.
bool HoldsForLibraries(
    const char* property,
    const std::function<Residual(Library, const TreeMotion&)>& residual_of) {
  bool holds = true;
  for (const Library library : kLibraries) {
    holds &= HoldsForTrees(
        property, [&](const TreeMotion& m) { return residual_of(library, m); });
  }
  return holds;
}

// All quantities of a motion in the conventions of a library.
struct Theirs {
  Theirs(Library library, const TreeMotion& m)
      : q(ConfigurationSize(library, m.tree)),
        v(m.tree.nv()),
        vdot(v),
        tau(v),
        N(v),
        M(m.tree.nv(), m.tree.nv()),
        our_M(M),
        our_N(v),
        our_tau(v),
        our_J(6, m.tree.nv()),
        J(our_J) {
    const Tree& tree = m.tree;
    Recursion scratch(tree);
    ComputeCrba(tree, m.q, &scratch, our_M);
    ComputeBias(tree, m.q, m.v, &scratch, our_N);
    ComputeRnea(tree, m.q, m.v, m.vdot, {}, &scratch, our_tau);
    std::vector<Pose> X_WB(tree.num_bodies());
    ComputePoses(tree, m.q, &X_WB);
    const int last = static_cast<int>(tree.frames().size()) - 1;
    ComputeFrameJacobian(tree, X_WB, last, Axes::kWorld, our_J);
    ExportConfiguration(library, tree, m.q, q);
    ExportVelocity(library, tree, m.q, m.v, v);
    ExportAcceleration(library, tree, m.q, m.v, m.vdot, vdot);
    ExportForces(library, tree, m.q, our_tau, tau);
    ExportMassMatrix(library, tree, m.q, our_M, M);
    ExportBias(library, tree, m.q, m.v, our_M, our_N, N);
    ExportJacobian(library, tree, m.q, our_J, J);
  }

  VectorXd q, v, vdot, tau, N;
  MatrixXd M, our_M;
  VectorXd our_N, our_tau;
  Matrix6Xd our_J, J;
};

// The motion of a random tree through (q, v) with constant v̇.
TreeMotion Moved(const TreeMotion& m, double dt) {
  TreeMotion moved = m;
  Integrate(m.tree, m.q, m.v + dt / 2 * m.vdot, dt, moved.q);
  moved.v = m.v + dt * m.vdot;
  return moved;
}

// The rate of q that the libraries document for a velocity. The quaternion e
// obeys de/dt = (0, w_W) e / 2 = e (0, w_B) / 2, with Hamilton's product.
VectorXd RateOf(Library library, const Tree& tree, const VectorXd& q,
                const VectorXd& v) {
  VectorXd rate(q.size());
  if (tree.is_floating()) {
    const auto half = [](const Vector3d& w) {
      return Quaterniond(0, w.x() / 2, w.y() / 2, w.z() / 2);
    };
    if (library == Library::kDrake) {
      const Quaterniond e(q[0], q[1], q[2], q[3]);
      const Quaterniond de = half(v.head<3>()) * e;
      rate.head<7>() << de.w(), de.vec(), v.segment<3>(3);
    } else if (library == Library::kMujoco) {
      const Quaterniond e(q[3], q[4], q[5], q[6]);
      const Quaterniond de = e * half(v.segment<3>(3));
      rate.head<7>() << v.head<3>(), de.w(), de.vec();
    } else {
      const Quaterniond e(q[6], q[3], q[4], q[5]);
      const Quaterniond de = e * half(v.segment<3>(3));
      rate.head<7>() << e * v.head<3>(), de.vec(), de.w();
    }
  }
  int k = tree.q_start();
  for (int j = 0; j < tree.num_joints(); ++j) {
    const double speed = v[tree.v_start() + j];
    if (library == Library::kPinocchio &&
        tree.joints()[j].type == JointType::kContinuous) {
      const double cosine = q[k], sine = q[k + 1];
      rate[k++] = -sine * speed;
      rate[k++] = cosine * speed;
    } else {
      rate[k++] = speed;
    }
  }
  return rate;
}

TEST(Conventions, VelocityIsTheRateOfTheConfiguration) {
  EXPECT_TRUE(HoldsForLibraries(
      "dq/dt = rate(q, v)", [](Library library, const TreeMotion& m) {
        if (m.tree.nv() == 0) return Residual{0, 0};
        const Theirs theirs(library, m);
        const VectorXd rate = RiddersRate([&](double dt) {
          VectorXd q(theirs.q.size()), moved(m.q);
          Integrate(m.tree, m.q, m.v, dt, moved);
          ExportConfiguration(library, m.tree, moved, q);
          return q;
        });
        return Compare(rate, RateOf(library, m.tree, theirs.q, theirs.v),
                       10 * kRiddersPrecision);
      }));
}

TEST(Conventions, AccelerationIsTheRateOfTheVelocity) {
  EXPECT_TRUE(
      HoldsForLibraries("dv/dt", [](Library library, const TreeMotion& m) {
        if (m.tree.nv() == 0) return Residual{0, 0};
        const VectorXd rate = RiddersRate([&](double dt) {
          const TreeMotion moved = Moved(m, dt);
          VectorXd v(m.tree.nv());
          ExportVelocity(library, m.tree, moved.q, moved.v, v);
          return v;
        });
        return Compare(rate, Theirs(library, m).vdot, 100 * kRiddersPrecision);
      }));
}

TEST(Conventions, KeepKineticEnergy) {
  EXPECT_TRUE(
      HoldsForLibraries("v'M v", [](Library library, const TreeMotion& m) {
        const Theirs theirs(library, m);
        const double ours = m.v.dot(theirs.our_M * m.v);
        const double energy = theirs.v.dot(theirs.M * theirs.v);
        return Residual{std::abs(ours - energy),
                        Rounding(10 + ours, m.tree.nv() + 10)};
      }));
}

TEST(Conventions, KeepPower) {
  EXPECT_TRUE(
      HoldsForLibraries("tau'v", [](Library library, const TreeMotion& m) {
        const Theirs theirs(library, m);
        return Residual{
            std::abs(theirs.our_tau.dot(m.v) - theirs.tau.dot(theirs.v)),
            Rounding(10 + theirs.tau.norm() * m.v.norm(), m.tree.nv() + 10)};
      }));
}

TEST(Conventions, KeepTheEquationOfMotion) {
  EXPECT_TRUE(HoldsForLibraries(
      "M v̇ + N = tau", [](Library library, const TreeMotion& m) {
        const Theirs theirs(library, m);
        const double scale =
            10 + theirs.M.norm() * theirs.vdot.norm() + theirs.N.norm();
        return Compare(theirs.M * theirs.vdot + theirs.N, theirs.tau,
                       Rounding(scale, m.tree.nv() + 10));
      }));
}

TEST(Conventions, JacobianTimesVelocityIsTheFramesVelocity) {
  EXPECT_TRUE(
      HoldsForLibraries("J v", [](Library library, const TreeMotion& m) {
        const Theirs theirs(library, m);
        const Vector6d V = theirs.our_J * m.v;
        Vector6d expected = V;
        if (library != Library::kDrake) expected << V.tail<3>(), V.head<3>();
        return Compare(
            theirs.J * theirs.v, expected,
            Rounding(10 + theirs.J.norm() * m.v.norm(), m.tree.nv() + 10));
      }));
}

TEST(Conventions, ImportIsTheInverseOfExport) {
  EXPECT_TRUE(HoldsForLibraries(
      "import(export(x)) = x", [](Library library, const TreeMotion& m) {
        const Theirs theirs(library, m);
        const Tree& tree = m.tree;
        const int n = tree.nv();
        VectorXd q(tree.nq()), v(n), vdot(n), tau(n), N(n);
        MatrixXd M(n, n);
        Matrix6Xd J(6, n);
        ImportConfiguration(library, tree, theirs.q, q);
        ImportVelocity(library, tree, q, theirs.v, v);
        ImportAcceleration(library, tree, q, v, theirs.vdot, vdot);
        ImportForces(library, tree, q, theirs.tau, tau);
        ImportMassMatrix(library, tree, q, theirs.M, M);
        ImportBias(library, tree, q, v, M, theirs.N, N);
        ImportJacobian(library, tree, q, theirs.J, J);
        // Pinocchio's continuous joints lose their whole turns.
        VectorXd turn = VectorXd::Zero(tree.nq());
        for (int j = 0; j < tree.num_joints(); ++j) {
          const int k = tree.q_start() + j;
          turn[k] = std::round((m.q[k] - q[k]) / (2 * M_PI)) * 2 * M_PI;
        }
        const double scale = 10 + m.q.norm() +
                             theirs.M.norm() * (1 + m.v.squaredNorm()) +
                             theirs.N.norm() + theirs.tau.norm() +
                             theirs.J.norm() + m.vdot.norm();
        MatrixXd errors(n, 4 + n + 6);
        errors << v - m.v, vdot - m.vdot, tau - theirs.our_tau,
            N - theirs.our_N, M - theirs.our_M, (J - theirs.our_J).transpose();
        const double error =
            std::max(errors.size() ? errors.cwiseAbs().maxCoeff() : 0.0,
                     (q + turn - m.q).lpNorm<Eigen::Infinity>());
        return Residual{error, Rounding(scale, n + 10)};
      }));
}

TEST(Conventions, PinocchiosMassMatrixDoesNotDependOnThePoseOfTheBase) {
  // Its base moves in its own axes. The mass matrices of Drake and MuJoCo turn
  // with the base.
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 6, 1});
  TreeMotion turned = m;
  turned.q.head<7>() << 4, 5, 6, 0.5, 0.5, -0.5, 0.5;
  const auto change = [&](Library library) {
    return (Theirs(library, m).M - Theirs(library, turned).M).norm();
  };
  EXPECT_LT(change(Library::kPinocchio), Rounding(100, 20));
  // M has entries near 1, so that 1e-3 is far above rounding and far below the
  // change by another orientation of the base.
  EXPECT_GT(change(Library::kDrake), 1e-3);
  EXPECT_GT(change(Library::kMujoco), 1e-3);
}

TEST(Conventions, MomentumMatrixGivesTheMomentumWithItsLinearPartFirst) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 6, 1});
  Recursion scratch(m.tree);
  CentroidalMomentum momentum(m.tree);
  ComputeCentroidalMomentum(m.tree, m.q, m.v, &scratch, &momentum);
  Matrix6Xd Ag(6, m.tree.nv());
  ExportJacobian(Library::kPinocchio, m.tree, m.q, momentum.H_G, Ag);
  const VectorXd L_G = momentum.H_G * m.v;
  const VectorXd hg = Ag * Theirs(Library::kPinocchio, m).v;
  EXPECT_LT((hg.head<3>() - L_G.tail<3>()).norm(), Rounding(100, 20));
  EXPECT_LT((hg.tail<3>() - L_G.head<3>()).norm(), Rounding(100, 20));
}

TEST(Conventions, DoNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 6, 1});
  for (const Library library : kLibraries) {
    Theirs theirs(library, m);
    Theirs ours = theirs;
    VectorXd q = m.q;
    CountMalloc count;
    ExportConfiguration(library, m.tree, m.q, theirs.q);
    ImportConfiguration(library, m.tree, theirs.q, q);
    ExportAcceleration(library, m.tree, m.q, m.v, m.vdot, theirs.vdot);
    ImportAcceleration(library, m.tree, m.q, m.v, theirs.vdot, ours.vdot);
    ExportMassMatrix(library, m.tree, m.q, theirs.our_M, theirs.M);
    ImportMassMatrix(library, m.tree, m.q, theirs.M, ours.M);
    ExportBias(library, m.tree, m.q, m.v, ours.our_M, ours.our_N, theirs.N);
    ImportBias(library, m.tree, m.q, m.v, ours.our_M, theirs.N, ours.N);
    ExportJacobian(library, m.tree, m.q, ours.our_J, theirs.J);
    ImportJacobian(library, m.tree, m.q, theirs.J, ours.J);
    EXPECT_EQ(count.allocations(), 0);
  }
}

}  // namespace
}  // namespace poise
