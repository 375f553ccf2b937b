// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/tree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "poise/dynamics/simd/lanes.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Inertia MakePoint(double mass, const Vector3d& p = Vector3d::Zero()) {
  return {mass, p, Matrix3d::Zero()};
}

JointSpec MakeJoint(const std::string& name, const std::string& parent,
                    const std::string& child,
                    JointType type = JointType::kRevolute) {
  JointSpec joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = child;
  return joint;
}

// Returns the message of the exception; empty if there is none.
template <typename Action>
std::string MessageOf(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// Returns the message of Build() for the links a, b, c and these joints.
std::string MessageOf(const std::vector<JointSpec>& joints) {
  TreeBuilder builder;
  for (const char* name : {"a", "b", "c"}) builder.AddLink(name, MakePoint(1));
  for (const JointSpec& joint : joints) builder.AddJoint(joint);
  return MessageOf([&] { builder.Build(); });
}

// Returns the message of AddJoint() after a change to a valid joint.
template <typename Change>
std::string MessageOfJoint(Change change) {
  JointSpec joint = MakeJoint("hip", "a", "b");
  change(&joint);
  return MessageOf([&] { TreeBuilder().AddJoint(joint); });
}

TEST(TreeBuilder, NamesAnInvalidLink) {
  const auto message_of = [](const std::string& name, const Inertia& M) {
    return MessageOf([&] { TreeBuilder().AddLink(name, M); });
  };
  EXPECT_EQ(message_of("", MakePoint(1)), "a link has no name");
  EXPECT_EQ(message_of("foot", MakePoint(-1)),
            "link 'foot': mass is -1, must be zero or positive");
  EXPECT_EQ(message_of("foot", MakePoint(kInfinity)),
            "link 'foot': mass is inf, must be finite");
  EXPECT_EQ(message_of("foot", MakePoint(1, {0, kNaN, 0})),
            "link 'foot': center of mass is nan, must be finite");
  Inertia M = MakePoint(1);
  M.I_G_B(2, 2) = kInfinity;
  EXPECT_EQ(message_of("foot", M),
            "link 'foot': inertia is inf, must be finite");
  M.I_G_B(2, 2) = 1;
  M.I_G_B(0, 1) = 0.1;
  EXPECT_EQ(message_of("foot", M), "link 'foot': inertia must be symmetric");
  M.I_G_B = Vector3d(1, -2, 1).asDiagonal();
  EXPECT_EQ(
      message_of("foot", M),
      "link 'foot': least principal moment is -2, must be zero or positive");
  M = {0, {0, 0, 0}, 0.5 * Matrix3d::Identity()};
  EXPECT_EQ(message_of("foot", M),
            "link 'foot': inertia is 0.5, must be zero where the mass is");
  EXPECT_EQ(message_of("foot", MakePoint(0)), "");
}

TEST(TreeBuilder, AcceptsImpossibleInertiasOnRequest) {
  TreeBuilder builder;
  builder.AcceptUnphysicalInertias();
  builder.AddLink("a", {0, {0, 0, 0}, Matrix3d::Identity()});
  builder.AddLink("b", {1, {0, 0, 0}, -Matrix3d::Identity()});
  builder.AddJoint(MakeJoint("hip", "a", "b"));
  const Tree tree = builder.Build();
  EXPECT_EQ(tree.inertias()[0].I_G_B, Matrix3d::Identity());
  EXPECT_EQ(tree.inertias()[1].I_G_B, -Matrix3d::Identity());
  EXPECT_EQ(MessageOf([&] { builder.AddLink("c", MakePoint(-1)); }),
            "link 'c': mass is -1, must be zero or positive");
}

TEST(TreeBuilder, AcceptsAPlateWithRoundedMoments) {
  const Inertia plate{1, {0, 0, 0}, Vector3d(1, 2, 3.00001).asDiagonal()};
  EXPECT_EQ(TreeBuilder().AddLink("a", plate).Build().total_mass(), 1);
}

TEST(TreeBuilder, AcceptsARoundedSymmetricInertia) {
  Inertia M{1, {0, 0, 0}, Matrix3d::Identity()};
  M.I_G_B(0, 2) = 0.1;
  M.I_G_B(2, 0) = std::nextafter(0.1, 1);
  const Matrix3d I = TreeBuilder().AddLink("a", M).Build().inertias()[0].I_G_B;
  EXPECT_EQ(I, I.transpose());
  EXPECT_NEAR(I(0, 2), 0.1, Rounding(0.1, 1));
}

TEST(TreeBuilder, NamesAnInvalidJoint) {
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->name = ""; }),
            "a joint has no name");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->X_PF.R(1, 1) = kNaN; }),
            "joint 'hip': rotation is nan, must be finite");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->X_PF.p.z() = kInfinity; }),
            "joint 'hip': position is inf, must be finite");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->X_PF.R *= 1.00002; }),
            "joint 'hip': rotation must be orthonormal");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->X_PF.R(0, 0) = -1; }),
            "joint 'hip': rotation must be orthonormal");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->axis_F.y() = kNaN; }),
            "joint 'hip': axis is nan, must be finite");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->axis_F.setZero(); }),
            "joint 'hip': axis is (0, 0, 0), must be another vector");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->armature = -2; }),
            "joint 'hip': armature is -2, must be zero or positive");
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) { j->armature = kInfinity; }),
            "joint 'hip': armature is inf, must be finite");
  EXPECT_EQ(MessageOfJoint([](JointSpec*) {}), "");
}

TEST(TreeBuilder, ProjectsARotationOfSixDigits) {
  JointSpec joint = MakeJoint("1", "a", "b");
  const auto rotation_of = [&joint] {
    const Tree tree =
        TreeBuilder().AddLink("a").AddLink("b").AddJoint(joint).Build();
    return tree.joints()[0].X_PF.R;
  };
  const Matrix3d R =
      Eigen::AngleAxisd(0.8, Vector3d(1, 2, 2) / 3).toRotationMatrix();
  joint.X_PF.R = R;
  EXPECT_EQ(rotation_of(), R);  // Equal to the bit.
  joint.X_PF.R(0, 1) += 3e-6;
  joint.X_PF.R *= 1 + 1e-6;
  const Matrix3d nearest = rotation_of();
  EXPECT_NEAR((nearest.transpose() * nearest - Matrix3d::Identity()).norm(), 0,
              Rounding(1, 9));
  // The error is half of the change, because its antisymmetric part is a
  // rotation.
  EXPECT_NEAR((nearest - R).norm(), 0, 3e-6);
  joint.X_PF.R = R;
  joint.X_PF.R.col(0) *= 1 + 1e-13;
  EXPECT_NE(rotation_of(), joint.X_PF.R);
}

TEST(TreeBuilder, IgnoresTheAxisOfAFixedJoint) {
  EXPECT_EQ(MessageOfJoint([](JointSpec* j) {
              j->type = JointType::kFixed;
              j->axis_F.setZero();
            }),
            "");
}

TEST(TreeBuilder, NamesTheErrorOfATree) {
  EXPECT_EQ(MessageOf([] { TreeBuilder().Build(); }), "there is no link");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b"), MakeJoint("1", "b", "c")}),
            "joint '1' is there twice");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b"), MakeJoint("2", "d", "c")}),
            "joint '2': there is no link 'd'");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b"), MakeJoint("2", "a", "d")}),
            "joint '2': there is no link 'd'");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b"), MakeJoint("2", "c", "b")}),
            "link 'b' has two parents, by joint '1' and joint '2'");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b")}),
            "two roots, link 'a' and link 'c'");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b"), MakeJoint("2", "b", "c"),
                       MakeJoint("3", "c", "a")}),
            "no root: every link has a parent");
  EXPECT_EQ(MessageOf({MakeJoint("1", "b", "c"), MakeJoint("2", "c", "b")}),
            "link 'b' is not connected to the root, link 'a': it is in or "
            "below a cycle");
  EXPECT_EQ(MessageOf({MakeJoint("1", "a", "b"), MakeJoint("2", "c", "c")}),
            "link 'c' is not connected to the root, link 'a': it is in or "
            "below a cycle");
  EXPECT_EQ(MessageOf([] { TreeBuilder().AddLink("a").AddLink("a").Build(); }),
            "link 'a' is there twice");
}

TEST(TreeBuilder, NamesAJointThatCannotBeLocked) {
  TreeBuilder builder;
  builder.AddLink("a").AddLink("b").AddLink("c");
  builder.AddJoint(MakeJoint("1", "a", "b"));
  builder.AddJoint(MakeJoint("2", "b", "c", JointType::kFixed));
  EXPECT_EQ(MessageOf([&] { TreeBuilder(builder).Lock("1", kNaN); }),
            "joint '1': locked value is nan, must be finite");
  EXPECT_EQ(MessageOf([&] { TreeBuilder(builder).Lock("3", 0).Build(); }),
            "lock: there is no joint '3'");
  EXPECT_EQ(MessageOf([&] { TreeBuilder(builder).Lock("2", 0).Build(); }),
            "joint '2': it is fixed, or locked twice");
  EXPECT_EQ(MessageOf([&] {
              TreeBuilder(builder).Lock("1", 0).Lock("1", 0).Build();
            }),
            "joint '1': it is fixed, or locked twice");
}

TEST(TreeBuilder, RejectsNonfiniteGravity) {
  EXPECT_EQ(MessageOf([] {
              TreeBuilder().SetGravity({0, 0, kNaN});
            }),
            "tree: gravity is nan, must be finite");
}

TEST(TreeBuilder, NormalizesAxes) {
  for (const double length : {1e-200, 5.0, 1e200}) {
    SCOPED_TRACE(length);
    JointSpec joint = MakeJoint("1", "a", "b", JointType::kPrismatic);
    joint.axis_F = length * Vector3d(0, 3, 4);
    const Tree tree =
        TreeBuilder().AddLink("a").AddLink("b").AddJoint(joint).Build();
    EXPECT_NEAR((tree.joints()[0].axis_F - Vector3d(0, 0.6, 0.8)).norm(), 0,
                Rounding(1, 3));
  }
}

TEST(TreeBuilder, OrdersBodiesDepthFirstAndBranchesAsGiven) {
  //  a - b - d     given breadth first; e hangs on the fixed link c.
  //   \- c - e
  TreeBuilder builder;
  for (const char* name : {"d", "e", "a", "b", "c"}) builder.AddLink(name);
  builder.AddJoint(MakeJoint("ab", "a", "b"));
  builder.AddJoint(MakeJoint("ac", "a", "c", JointType::kFixed));
  builder.AddJoint(MakeJoint("ce", "c", "e", JointType::kContinuous));
  builder.AddJoint(MakeJoint("bd", "b", "d", JointType::kPrismatic));
  const Tree tree = builder.Build();
  ASSERT_EQ(tree.num_joints(), 3);
  EXPECT_EQ(tree.joints()[0].name, "ab");
  EXPECT_EQ(tree.joints()[1].name, "bd");
  EXPECT_EQ(tree.joints()[2].name, "ce");
  EXPECT_EQ(tree.joints()[1].type, JointType::kPrismatic);
  EXPECT_EQ(tree.joints()[2].type, JointType::kContinuous);
  EXPECT_EQ(tree.joints()[0].parent, 0);
  EXPECT_EQ(tree.joints()[1].parent, 1);
  EXPECT_EQ(tree.joints()[2].parent, 0);
  EXPECT_EQ(tree.joint_maps().parent, (std::vector<int>{0, 0, 1, 0}));
  EXPECT_EQ(tree.joint_maps().end, (std::vector<int>{4, 3, 3, 4}));
  EXPECT_EQ(tree.frames()[*tree.FindFrame("c")].body, 0);
  EXPECT_EQ(tree.frames()[*tree.FindFrame("e")].body, 3);
}

TEST(TreeBuilder, WeldsFixedLinksAndKeepsTheirFrames) {
  // Two points of 1 kg and 3 kg; the second is 0.4 m along y of the rotated
  // frame.
  JointSpec joint = MakeJoint("1", "a", "b", JointType::kFixed);
  joint.X_PF.p = Vector3d(1, 0, 0);
  joint.X_PF.R =
      Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()).toRotationMatrix();
  Inertia M_b = MakePoint(3, {0, 0.4, 0});
  M_b.I_G_B = Vector3d(1, 2, 3).asDiagonal();
  const Tree tree = TreeBuilder()
                        .AddLink("a", MakePoint(1, {0.2, 0, 0}))
                        .AddLink("b", M_b)
                        .AddJoint(joint)
                        .Build(BaseType::kFixed);
  ASSERT_EQ(tree.num_bodies(), 1);
  EXPECT_EQ(tree.nv(), 0);
  EXPECT_EQ(tree.total_mass(), 4);
  // b's point is at (0.6, 0, 0): 0.4 m from a's.
  const Inertia& M = tree.inertias()[0];
  EXPECT_EQ(M.mass, 4);
  EXPECT_NEAR((M.p_BoG_B - Vector3d(0.5, 0, 0)).norm(), 0, Rounding(1, 3));
  const double reduced = 0.75 * 0.4 * 0.4;
  const Matrix3d I =
      Vector3d(2, 1 + reduced, 3 + reduced).asDiagonal().toDenseMatrix();
  EXPECT_NEAR((M.I_G_B - I).norm(), 0, Rounding(3, 9));
  const Frame& frame = tree.frames()[*tree.FindFrame("b")];
  EXPECT_EQ(frame.body, 0);
  EXPECT_EQ(frame.X_BF.p, joint.X_PF.p);
  EXPECT_EQ(frame.X_BF.R, joint.X_PF.R);
}

TEST(TreeBuilder, WeldsMasslessLinksWithoutDividingByZero) {
  const Tree tree = TreeBuilder()
                        .AddLink("a")
                        .AddLink("b")
                        .AddJoint(MakeJoint("1", "a", "b", JointType::kFixed))
                        .Build();
  EXPECT_EQ(tree.inertias()[0].mass, 0);
  EXPECT_TRUE(tree.inertias()[0].p_BoG_B.isZero(0));
  EXPECT_TRUE(tree.inertias()[0].I_G_B.isZero(0));
}

TEST(TreeBuilder, LocksAtTheValue) {
  for (const JointType type : {JointType::kRevolute, JointType::kPrismatic}) {
    JointSpec joint = MakeJoint("1", "a", "b", type);
    joint.axis_F = Vector3d::UnitZ();
    joint.X_PF.p = Vector3d(0, 1, 0);
    const Tree tree = TreeBuilder()
                          .AddLink("a")
                          .AddLink("b")
                          .AddJoint(joint)
                          .Lock("1", 0.5)
                          .Build();
    EXPECT_EQ(tree.num_joints(), 0);
    EXPECT_FALSE(tree.FindJoint("1").has_value());
    const Pose& X_BF = tree.frames()[*tree.FindFrame("b")].X_BF;
    if (type == JointType::kPrismatic) {
      EXPECT_EQ(X_BF.p, Vector3d(0, 1, 0.5));
      EXPECT_EQ(X_BF.R, Matrix3d::Identity());
    } else {
      EXPECT_EQ(X_BF.p, Vector3d(0, 1, 0));
      EXPECT_NEAR(X_BF.R(1, 0), std::sin(0.5), Rounding(1, 1));
    }
  }
}

TEST(Tree, ReturnsItsSizes) {
  TreeBuilder builder;
  builder.AddLink("a", MakePoint(2)).AddLink("b", MakePoint(3));
  builder.AddJoint(MakeJoint("1", "a", "b"));
  const Tree floating = builder.Build();
  EXPECT_EQ(floating.num_bodies(), 2);
  EXPECT_EQ(floating.nq(), 8);
  EXPECT_EQ(floating.nv(), 7);
  EXPECT_EQ(floating.q_start(), 7);
  EXPECT_EQ(floating.v_start(), 6);
  EXPECT_EQ(floating.total_mass(), 5);
  EXPECT_EQ(floating.gravity_W(), Vector3d(0, 0, -9.81));
  Eigen::VectorXd neutral(8);
  neutral << 0, 0, 0, 0, 0, 0, 1, 0;
  EXPECT_EQ(floating.MakeNeutral(), neutral);

  const Tree fixed = builder.SetGravity({1, 2, 3}).Build(BaseType::kFixed);
  EXPECT_EQ(fixed.nq(), 1);
  EXPECT_EQ(fixed.nv(), 1);
  EXPECT_EQ(fixed.q_start(), 0);
  EXPECT_EQ(fixed.v_start(), 0);
  EXPECT_EQ(fixed.MakeNeutral(), Eigen::VectorXd::Zero(1));
  EXPECT_EQ(fixed.gravity_W(), Vector3d(1, 2, 3));
}

TEST(JointMaps, HoldABaseThatCannotMove) {
  const Tree body = TreeBuilder().AddLink("a").Build();
  EXPECT_EQ(body.joint_maps().parent[0], 0);
  EXPECT_EQ(body.joint_maps().end[0], 1);
  const Mat3 R = body.joint_maps().R_constant[0];
  EXPECT_EQ(ToEigen(R), Matrix3d::Identity());
}

TEST(Tree, ScalesAllInertias) {
  JointSpec joint = MakeJoint("hip", "a", "b");
  joint.armature = 0.5;
  const Inertia M{2, {1, 2, 3}, Matrix3d::Identity()};
  const Tree tree =
      TreeBuilder().AddLink("a", M).AddLink("b", M).AddJoint(joint).Build();
  const Tree scaled = tree.WithScaledInertias(4);
  EXPECT_EQ(scaled.total_mass(), 16);
  EXPECT_EQ(scaled.joints()[0].armature, 2);
  EXPECT_EQ(scaled.joint_maps().armature[1], 2);
  for (const int b : {0, 1}) {
    EXPECT_EQ(scaled.inertias()[b].mass, 8);
    EXPECT_EQ(scaled.inertias()[b].p_BoG_B, M.p_BoG_B);
    EXPECT_EQ(scaled.inertias()[b].I_G_B, 4 * M.I_G_B);
    EXPECT_EQ(scaled.mass_moments()[b].mass, 8);
  }
}

TEST(Tree, RejectsANonpositiveScale) {
  const Tree tree = TreeBuilder().AddLink("a", MakePoint(1)).Build();
  EXPECT_EQ(MessageOf([&] { tree.WithScaledInertias(-1); }),
            "tree: factor of the inertias is -1, must be positive and finite");
  EXPECT_NE(MessageOf([&] { tree.WithScaledInertias(0); }), "");
  EXPECT_NE(MessageOf([&] { tree.WithScaledInertias(kInfinity); }), "");
  EXPECT_NE(MessageOf([&] { tree.WithScaledInertias(kNaN); }), "");
}

TEST(Tree, FindsByName) {
  const Tree tree = TreeBuilder()
                        .AddLink("a")
                        .AddLink("b")
                        .AddLink("c")
                        .AddJoint(MakeJoint("ab", "a", "b"))
                        .AddJoint(MakeJoint("bc", "b", "c"))
                        .Build();
  EXPECT_EQ(tree.FindJoint("bc"), 1);
  EXPECT_EQ(tree.FindFrame("b"), 1);
  EXPECT_FALSE(tree.FindJoint("b").has_value());
  EXPECT_FALSE(tree.FindFrame("bc").has_value());
}

TEST(TreeBuilder, AcceptsVeryDeepChains) {
  TreeBuilder builder;
  builder.AddLink("0", MakePoint(1));
  for (int i = 1; i <= 20000; ++i) {
    builder.AddLink(std::to_string(i), MakePoint(1));
    builder.AddJoint(MakeJoint(std::to_string(i), std::to_string(i - 1),
                               std::to_string(i), JointType::kFixed));
  }
  const Tree tree = builder.Build();
  EXPECT_EQ(tree.num_bodies(), 1);
  EXPECT_EQ(tree.inertias()[0].mass, 20001);
}

}  // namespace
}  // namespace poise
