// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/collision/collision_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/collision/body_capsules.h"
#include "poise/tests/util/count_malloc.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

using Eigen::Vector3d;

Inertia BodyOf(double mass) {
  Inertia M;
  M.mass = mass;
  M.I_G_B = 0.01 * mass * Eigen::Matrix3d::Identity();
  return M;
}

// A link on a revolute joint about an axis at p on its parent.
struct Limb {
  std::string name;
  std::string parent;
  Vector3d p;
  Vector3d axis;
  double mass = 1;
};

Robot MakeLimbs(const std::vector<Limb>& limbs) {
  TreeBuilder builder;
  builder.AddLink("trunk", BodyOf(10));
  for (const Limb& limb : limbs) {
    builder.AddLink(limb.name, BodyOf(limb.mass));
    JointSpec joint;
    joint.name = limb.name + "_joint";
    joint.type = JointType::kRevolute;
    joint.parent = limb.parent;
    joint.child = limb.name;
    joint.X_PF.p = limb.p;
    joint.axis_F = limb.axis;
    builder.AddJoint(joint);
  }
  return MakeRobot(builder.Build());
}

void AddShape(const std::string& link, const Geometry& geometry,
              const Vector3d& p, std::vector<Shape>* shapes,
              const RobotModel& model) {
  Pose X;
  X.p = p;
  shapes->push_back({*model.tree.FindFrame(link), X, geometry});
}

// Two arms of two rods of 0.3 m each on a trunk, 0.4 m apart.
Robot MakeTwoArms() {
  std::vector<Limb> limbs;
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "l_" : "r_";
    limbs.push_back(
        {name + "upper", "trunk", {0, 0.2 * side, 0.4}, Vector3d::UnitX()});
    limbs.push_back(
        {name + "lower", name + "upper", {0, 0, -0.3}, Vector3d::UnitX()});
  }
  Robot robot = MakeLimbs(limbs);
  AddShape("trunk", Cylinder{0.08, 0.4}, {0, 0, 0.2}, &robot.model.collisions,
           robot.model);
  for (const std::string link : {"l_upper", "l_lower", "r_upper", "r_lower"}) {
    AddShape(link, Cylinder{0.03, 0.24}, {0, 0, -0.15}, &robot.model.collisions,
             robot.model);
  }
  return robot;
}

bool HasPair(const CollisionModel& model, const std::string& a,
             const std::string& b) {
  return std::any_of(model.pairs.begin(), model.pairs.end(),
                     [&](const CollisionPair& pair) {
                       const std::string& x = model.names[pair.a];
                       const std::string& y = model.names[pair.b];
                       return (x == a && y == b) || (x == b && y == a);
                     });
}

std::vector<Pose> PosesAt(const Robot& robot, const Eigen::VectorXd& q) {
  std::vector<Pose> X_WB(robot.model.tree.num_bodies());
  ComputePoses(robot.model.tree, q, &X_WB);
  return X_WB;
}

TEST(MakeCollisionModel, HasThePairsThatMayTouch) {
  const CollisionModel model = MakeCollisionModel(MakeTwoArms().model);
  EXPECT_TRUE(HasPair(model, "trunk", "l_lower"));
  EXPECT_TRUE(HasPair(model, "l_lower", "r_lower"));
  EXPECT_FALSE(HasPair(model, "trunk", "l_upper"));    // One joint.
  EXPECT_FALSE(HasPair(model, "l_upper", "l_lower"));  // One joint.
}

TEST(MakeCollisionModel, LeavesOutPairsThatStayApart) {
  Robot robot = MakeTwoArms();
  for (JointLimits& limits : robot.model.limits) {
    limits.lower = -0.1;
    limits.upper = 0.1;
  }
  EXPECT_TRUE(MakeCollisionModel(robot.model).pairs.empty());
}

TEST(MakeCollisionModel, LeavesOutPairsThatAlwaysTouch) {
  Robot robot = MakeTwoArms();
  // A ball around an elbow touches the trunk's ball in each posture.
  AddShape("trunk", Sphere{0.9}, {0, 0, 0.3}, &robot.model.collisions,
           robot.model);
  const CollisionModel model = MakeCollisionModel(robot.model);
  EXPECT_FALSE(HasPair(model, "trunk", "l_lower"));
  EXPECT_TRUE(HasPair(model, "l_lower", "r_lower"));
}

// A hip of two joints 2 cm apart: the thigh is a neighbor of the trunk.
TEST(MakeCollisionModel, TakesJointsCloseToEachOtherAsOne) {
  for (const double gap : {0.02, 0.2}) {
    Robot robot = MakeLimbs({{"hip", "trunk", {0, 0, 0}, Vector3d::UnitX()},
                             {"thigh", "hip", {0, 0, -gap}, Vector3d::UnitY()},
                             {"shank", "thigh", {0, 0, -0.5}, {0, 1, 0}}});
    AddShape("trunk", Sphere{0.1}, {0, 0, 0.15}, &robot.model.collisions,
             robot.model);
    AddShape("thigh", Cylinder{0.04, 0.4}, {0, 0, -0.25},
             &robot.model.collisions, robot.model);
    const CollisionModel model = MakeCollisionModel(robot.model);
    EXPECT_EQ(HasPair(model, "trunk", "thigh"), gap > 0.1);
  }
}

TEST(MakeCollisionModel, IsTheSameOnEveryCall) {
  const Robot robot = LoadHumanoid();
  const CollisionModel a = MakeCollisionModel(robot.model);
  const CollisionModel b = MakeCollisionModel(robot.model);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (size_t i = 0; i < a.pairs.size(); ++i) {
    EXPECT_EQ(a.pairs[i].a, b.pairs[i].a);
    EXPECT_EQ(a.pairs[i].b, b.pairs[i].b);
  }
}

TEST(MakeCollisionModel, KeepsHandsFromThighsAndLegsFromEachOther) {
  const CollisionModel model = MakeCollisionModel(LoadHumanoid().model);
  for (const std::string side : {"l_", "r_"}) {
    EXPECT_TRUE(HasPair(model, side + "hand", side + "thigh"));
    EXPECT_TRUE(HasPair(model, side + "forearm", "pelvis"));
  }
  EXPECT_TRUE(HasPair(model, "l_thigh", "r_thigh"));
  EXPECT_TRUE(HasPair(model, "l_shank", "r_shank"));
  EXPECT_TRUE(HasPair(model, "l_foot", "r_foot"));
}

TEST(ComputeClearance, IsTheDistanceOfTheNearestPair) {
  const Robot robot = MakeTwoArms();
  const Tree& tree = robot.model.tree;
  const CollisionModel model = MakeCollisionModel(robot.model);
  Eigen::VectorXd q = tree.MakeNeutral();
  // Hanging: the rods' axes are 0.2 m from the trunk's, the trunk ends 0.3 m
  // above the ends of the upper arms.
  const Clearance hanging = ComputeClearance(model, PosesAt(robot, q));
  EXPECT_GT(hanging.distance, 0.05);
  EXPECT_LT(hanging.distance, 0.2 - 0.08 - 0.03 + 0.1);
  // Both elbows bent inwards by 90 deg: the rods meet in the middle.
  q[tree.q_start() + *tree.FindJoint("l_lower_joint")] = -M_PI / 2;
  q[tree.q_start() + *tree.FindJoint("r_lower_joint")] = M_PI / 2;
  const Clearance crossed = ComputeClearance(model, PosesAt(robot, q));
  EXPECT_LT(crossed.distance, 0);
  ASSERT_GE(crossed.pair, 0);
  const CollisionPair& worst = model.pairs[crossed.pair];
  EXPECT_LE(ComputePairDistance(model, worst, PosesAt(robot, q), 0).distance,
            crossed.distance);
}

TEST(ComputeClearance, IsInfiniteWithoutPairs) {
  const Robot robot = MakeBall(0.1, 1);
  const CollisionModel model = MakeCollisionModel(robot.model);
  const Clearance clearance =
      ComputeClearance(model, PosesAt(robot, robot.model.tree.MakeNeutral()));
  EXPECT_EQ(clearance.pair, -1);
  EXPECT_EQ(clearance.distance, INFINITY);
}

TEST(ComputeClearance, DoesNotAllocate) {
  const Robot robot = LoadHumanoid();
  const CollisionModel model = MakeCollisionModel(robot.model);
  const std::vector<Pose> X_WB = PosesAt(robot, robot.q_nominal);
  const CountMalloc count;
  EXPECT_GT(ComputeClearance(model, X_WB).distance, 0);
  EXPECT_EQ(count.allocations(), 0);
}

TEST(BoundPairDistance, IsALowerBound) {
  const Robot robot = LoadHumanoid();
  const CollisionModel model = MakeCollisionModel(robot.model);
  const std::vector<Pose> X_WB = PosesAt(robot, robot.q_nominal);
  for (const CollisionPair& pair : model.pairs) {
    EXPECT_LE(BoundPairDistance(model, pair, X_WB),
              ComputePairDistance(model, pair, X_WB, 0).distance + 1e-12);
  }
}

TEST(FitBodyCapsules, PrefersCollisionShapesToVisualOnes) {
  Robot robot = MakeLimbs({{"arm", "trunk", {0, 0, 1}, Vector3d::UnitX()}});
  const auto radius = [&] {
    return FitBodyCapsules(robot.model)[1].at(0).radius;
  };
  AddShape("arm", Sphere{0.3}, {0, 0, 0}, &robot.model.visuals, robot.model);
  EXPECT_NEAR(radius(), 0.3, 1e-12);
  AddShape("arm", Sphere{0.2}, {0, 0, 0}, &robot.model.collisions, robot.model);
  EXPECT_NEAR(radius(), 0.2, 1e-12);
}

TEST(FitBodyCapsules, LaysACapsuleBetweenTheJointsOfABodyWithoutShapes) {
  const Robot robot = MakeLimbs({{"upper", "trunk", {0, 0, 1}, {1, 0, 0}},
                                 {"lower", "upper", {0, 0, 0.5}, {1, 0, 0}}});
  const Capsule bone = FitBodyCapsules(robot.model)[1].at(0);
  EXPECT_NEAR((bone.end - bone.start).norm(), 0.5, 1e-9);
  EXPECT_NEAR(bone.radius, 0.05, 1e-9);
}

TEST(FitBodyCapsules, FoldsFingersIntoTheHand) {
  Robot robot =
      MakeLimbs({{"hand", "trunk", {0, 0, 1}, Vector3d::UnitX()},
                 {"finger", "hand", {0, 0, 0.1}, Vector3d::UnitX(), 0.01}});
  AddShape("hand", Sphere{0.05}, {0, 0, 0}, &robot.model.collisions,
           robot.model);
  AddShape("finger", Sphere{0.01}, {0, 0, 0.05}, &robot.model.visuals,
           robot.model);
  const auto capsules = FitBodyCapsules(robot.model);
  EXPECT_TRUE(capsules[2].empty());
  double top = 0;
  for (const Capsule& c : capsules[1]) {
    top = std::max(top, std::max(c.start.z(), c.end.z()) + c.radius);
  }
  EXPECT_NEAR(top, 0.16, 1e-9);
}

TEST(FitBodyCapsules, CutsAThickBox) {
  Robot robot = MakeLimbs({{"arm", "trunk", {0, 0, 1}, Vector3d::UnitX()}});
  AddShape("trunk", Box{{0.3, 0.3, 0.4}}, {0, 0, 0}, &robot.model.collisions,
           robot.model);
  const auto trunk = FitBodyCapsules(robot.model)[0];
  ASSERT_EQ(trunk.size(), 4u);
  double side = 0;
  for (const Capsule& c : trunk) {
    side = std::max(side, std::max(c.start.y(), c.end.y()) + c.radius);
  }
  // One capsule would be 0.21 m thick.
  EXPECT_GE(side, 0.15);
  EXPECT_LT(side, 0.19);
}

TEST(FitBodyCapsules, ContainsTheVerticesOfMeshes) {
  const Robot robot = MakeLimbs({{"arm", "trunk", {0, 0, 1}, {1, 0, 0}}});
  SurfacePoints points(2);
  points[1] = {{0, 0, 0}, {0.1, 0, 0.6}, {-0.1, 0.1, 0.3}};
  const auto arm = FitBodyCapsules(robot.model, points)[1];
  ASSERT_EQ(arm.size(), 1u);
  for (const Vector3d& p : points[1]) {
    const Capsule point{p, p, 0};
    EXPECT_LE(ComputeClosestPoints(arm[0], point, 0).distance, 1e-9);
  }
}

TEST(Reach, IsTheLongestChain) {
  EXPECT_NEAR(Reach(MakeTwoArms().model.tree), std::hypot(0.2, 0.4) + 0.3,
              1e-12);
}

}  // namespace
}  // namespace poise
