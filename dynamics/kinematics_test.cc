// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "poise/dynamics/integrate.h"
#include "poise/math/so3.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/ridders.h"
#include "poise/tests/util/tolerance.h"
#include "poise/tests/util/tree_cases.h"

namespace poise {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Returns the velocity at time t with constant v̇.
VectorXd FlowVelocity(const TreeMotion& m, double t) {
  return m.v + t * m.vdot;
}

// Returns the configuration at time t along v, exact to first order in t.
VectorXd FlowConfiguration(const TreeMotion& m, double t) {
  VectorXd q(m.tree.nq());
  Integrate(m.tree, m.q, m.v + 0.5 * t * m.vdot, t, q);
  return q;
}

std::vector<Pose> PosesAt(const TreeMotion& m, const VectorXd& q) {
  std::vector<Pose> X_WB(m.tree.num_bodies());
  ComputePoses(m.tree, q, &X_WB);
  return X_WB;
}

std::vector<SpatialMotion> VelocitiesAt(const TreeMotion& m, const VectorXd& q,
                                        const VectorXd& v) {
  std::vector<SpatialMotion> V_WB_W(m.tree.num_bodies());
  ComputeVelocities(m.tree, PosesAt(m, q), v, &V_WB_W);
  return V_WB_W;
}

std::vector<SpatialAcceleration> AccelerationsOf(const TreeMotion& m) {
  std::vector<SpatialAcceleration> A_WB_W(m.tree.num_bodies());
  ComputeAccelerations(m.tree, PosesAt(m, m.q), VelocitiesAt(m, m.q, m.v), m.v,
                       m.vdot, &A_WB_W);
  return A_WB_W;
}

// An arm of two links of 1 m and 2 m in the plane z = 0, with a prismatic joint
// at its end along the second link.
Tree MakeArm() {
  TreeBuilder builder;
  for (const char* name : {"base", "upper", "lower", "slide"}) {
    builder.AddLink(name);
  }
  const auto add = [&builder](const char* parent, const char* child,
                              JointType type, double x, const Vector3d& axis) {
    JointSpec joint;
    joint.name = child;
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    joint.X_PF.p.x() = x;
    joint.axis_F = axis;
    builder.AddJoint(joint);
  };
  add("base", "upper", JointType::kRevolute, 0, Vector3d::UnitZ());
  add("upper", "lower", JointType::kContinuous, 1, Vector3d::UnitZ());
  add("lower", "slide", JointType::kPrismatic, 2, Vector3d::UnitX());
  return builder.Build(BaseType::kFixed);
}

TEST(Kinematics, OfAnArmAreTheClosedForm) {
  const Tree tree = MakeArm();
  const double a = 0.4, b = 0.9, s = 0.3;
  const double a_dot = 1.1, b_dot = -0.7, s_dot = 0.6;
  VectorXd q(3), v(3);
  q << a, b, s;
  v << a_dot, b_dot, s_dot;
  std::vector<Pose> X_WB(4);
  ComputePoses(tree, q, &X_WB);
  // Position of the end by polar coordinates.
  const Vector3d e(std::cos(a + b), std::sin(a + b), 0);
  const Vector3d n(-e.y(), e.x(), 0);
  const Vector3d p_elbow(std::cos(a), std::sin(a), 0);
  EXPECT_NEAR((X_WB[3].p - (p_elbow + (2 + s) * e)).norm(), 0, Rounding(4, 4));
  EXPECT_NEAR((X_WB[3].R.col(0) - e).norm(), 0, Rounding(2, 4));

  std::vector<SpatialMotion> V_WB_W(4);
  std::vector<SpatialAcceleration> A_WB_W(4);
  ComputeVelocities(tree, X_WB, v, &V_WB_W);
  const Vector3d z = Vector3d::UnitZ();
  const double w = a_dot + b_dot;
  const Vector3d v_end = a_dot * z.cross(p_elbow) + s_dot * e + (2 + s) * w * n;
  EXPECT_NEAR(V_WB_W[3].angular.z(), w, Rounding(2, 2));
  EXPECT_NEAR((V_WB_W[3].linear - v_end).norm(), 0, Rounding(8, 4));

  ComputeAccelerations(tree, X_WB, V_WB_W, v, VectorXd::Zero(3), &A_WB_W);
  const Vector3d a_end =
      -a_dot * a_dot * p_elbow - (2 + s) * w * w * e + 2 * s_dot * w * n;
  EXPECT_TRUE(A_WB_W[3].angular.isZero(0));
  EXPECT_NEAR((A_WB_W[3].linear - a_end).norm(), 0, Rounding(8, 6));
}

TEST(Kinematics, DoNotDependOnTheNormOfTheQuaternion) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 5, 1});
  const std::vector<Pose> expected = PosesAt(m, m.q);
  for (const double norm : {1e-300, 1e-160, 0.5, 3.0, 1e160, 1e300}) {
    SCOPED_TRACE(norm);
    VectorXd q = m.q;
    q.segment<4>(3) *= norm;
    EXPECT_NEAR((PosesAt(m, q).back().R - expected.back().R).norm(), 0,
                Rounding(2, 9));
  }
  VectorXd q = m.q;
  q.segment<4>(3).setZero();
  for (const Pose& X_WB : PosesAt(m, q)) {
    EXPECT_TRUE(X_WB.R.array().isNaN().all());
  }
}

TEST(Kinematics, VelocitiesAreTheRatesOfPoses) {
  EXPECT_TRUE(HoldsForTrees("V_WB = d/dt X_WB", [](const TreeMotion& m) {
    const std::vector<Pose> X_WB = PosesAt(m, m.q);
    const std::vector<SpatialMotion> V_WB_W = VelocitiesAt(m, m.q, m.v);
    const int last = m.tree.num_bodies() - 1;
    const VectorXd rate = RiddersRate([&](double t) {
      const Pose X = PosesAt(m, FlowConfiguration(m, t))[last];
      VectorXd result(6);
      result << LogSo3(X.R * X_WB[last].R.transpose()), X.p;
      return result;
    });
    const double scale = 10 + V_WB_W[last].vector().norm();
    return Compare(V_WB_W[last].vector(), rate, kRiddersPrecision * scale);
  }));
}

TEST(Kinematics, AccelerationsAreTheRatesOfVelocities) {
  EXPECT_TRUE(HoldsForTrees("A_WB = d/dt V_WB", [](const TreeMotion& m) {
    const std::vector<SpatialAcceleration> A_WB_W = AccelerationsOf(m);
    const int last = m.tree.num_bodies() - 1;
    const VectorXd rate = RiddersRate([&](double t) {
      return VelocitiesAt(m, FlowConfiguration(m, t), FlowVelocity(m, t))[last]
          .vector();
    });
    const double scale = 100 + A_WB_W[last].vector().norm();
    return Compare(A_WB_W[last].vector(), rate, kRiddersPrecision * scale);
  }));
}

TEST(Kinematics, FramesMoveAsTheirBodies) {
  // A frame moves like a body with this frame as its own.
  const auto rotation = Eigen::AngleAxisd(0.8, Vector3d(1, 2, 2) / 3);
  TreeBuilder builder;
  for (const char* name : {"base", "body", "frame"}) builder.AddLink(name);
  JointSpec joint;
  joint.name = "joint";
  joint.type = JointType::kRevolute;
  joint.parent = "base";
  joint.child = "body";
  joint.axis_F = Vector3d(0.1, -2, 1);
  builder.AddJoint(joint);
  joint.name = "weld";
  joint.parent = "body";
  joint.child = "frame";
  joint.X_PF = {rotation.toRotationMatrix(), Vector3d(0.3, 0.4, -0.5)};
  joint.axis_F = Vector3d::UnitX();
  TreeBuilder with_body = builder;
  with_body.AddJoint(joint);
  joint.type = JointType::kFixed;
  builder.AddJoint(joint);
  const Tree tree = builder.Build(), tree_with_body = with_body.Build();

  VectorXd q(8), v(7), vdot(7);
  q << 0.1, 0.2, 0.3, 0.5, -0.5, 0.5, 0.5, 0.7;
  v << 1, -2, 3, 0.4, 0.5, 0.6, 1.5;
  vdot << 2, 1, -3, 0.7, 0.8, 0.9, 2.5;
  const auto extended = [](const VectorXd& x) {
    VectorXd result(x.size() + 1);
    result << x, 0;
    return result;
  };
  std::vector<Pose> X(2), X_b(3);
  std::vector<SpatialMotion> V(2), V_b(3);
  std::vector<SpatialAcceleration> A(2), A_b(3);
  ComputePoses(tree, q, &X);
  ComputeVelocities(tree, X, v, &V);
  ComputeAccelerations(tree, X, V, v, vdot, &A);
  ComputePoses(tree_with_body, extended(q), &X_b);
  ComputeVelocities(tree_with_body, X_b, extended(v), &V_b);
  ComputeAccelerations(tree_with_body, X_b, V_b, extended(v), extended(vdot),
                       &A_b);
  const int frame = *tree.FindFrame("frame");
  const double tolerance = Rounding(30, 10);
  const Pose X_WF = FramePose(tree, X, frame);
  EXPECT_NEAR((X_WF.R - X_b[2].R).norm(), 0, tolerance);
  EXPECT_NEAR((X_WF.p - X_b[2].p).norm(), 0, tolerance);
  EXPECT_NEAR((FrameVelocity(tree, X, V, frame) - V_b[2]).vector().norm(), 0,
              tolerance);
  EXPECT_NEAR(
      (FrameAcceleration(tree, X, V, A, frame) - A_b[2]).vector().norm(), 0,
      tolerance);
}

TEST(Kinematics, DoNotAllocate) {
  const TreeMotion m =
      MakeTreeMotion({TreeShape::kAny, BaseType::kFloating, 12, 1});
  std::vector<Pose> X_WB(m.tree.num_bodies());
  std::vector<SpatialMotion> V_WB_W(m.tree.num_bodies());
  std::vector<SpatialAcceleration> A_WB_W(m.tree.num_bodies());
  CountMalloc count;
  ComputePoses(m.tree, m.q, &X_WB);
  ComputeVelocities(m.tree, X_WB, m.v, &V_WB_W);
  ComputeAccelerations(m.tree, X_WB, V_WB_W, m.v, m.vdot, &A_WB_W);
  EXPECT_EQ(count.allocations(), 0);
}

}  // namespace
}  // namespace poise
