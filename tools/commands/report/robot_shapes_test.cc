// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/robot_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>

#include "poise/robot/mesh/triangle_mesh.h"
#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

// Returns the inertia of a uniform ellipsoid.
Inertia EllipsoidInertia(double mass, const Eigen::Vector3d& half_axes) {
  const Eigen::Vector3d s = half_axes.cwiseAbs2();
  Inertia M;
  M.mass = mass;
  M.I_G_B =
      (mass / 5 * Eigen::Vector3d(s.y() + s.z(), s.z() + s.x(), s.x() + s.y()))
          .asDiagonal();
  return M;
}

// Makes two links with a joint at p. A camera is fixed to the first link.
RobotModel Arm(const Inertia& M_upper, const Eigen::Vector3d& p) {
  JointSpec elbow;
  elbow.name = "elbow";
  elbow.type = JointType::kRevolute;
  elbow.parent = "upper";
  elbow.child = "lower";
  elbow.X_PF.p = p;
  JointSpec mount;
  mount.name = "mount";
  mount.parent = "upper";
  mount.child = "camera";
  mount.X_PF.p = {0, 0, 0.5};
  RobotModel robot{"arm",
                   TreeBuilder()
                       .AddLink("upper", M_upper)
                       .AddLink("lower", EllipsoidInertia(1, {0.1, 0.1, 0.1}))
                       .AddLink("camera")
                       .AddJoint(elbow)
                       .AddJoint(mount)
                       .Build(),
                   {},
                   {},
                   {},
                   {},
                   0};
  return robot;
}

TEST(RobotShapes, DrawsBodyWithoutPrimitivesAsEllipsoidAndCapsules) {
  const Eigen::Vector3d half_axes(0.05, 0.2, 0.1);
  Inertia M = EllipsoidInertia(3, half_axes);
  M.p_BoG_B = {0.01, 0.02, 0.03};
  const Eigen::Matrix3d R(
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const Eigen::Matrix3d I = R * M.I_G_B * R.transpose();
  M.I_G_B = (I + I.transpose()) / 2;  // Exactly symmetric.
  const auto shapes = MakeBodyShapes(Arm(M, {0, 0.3, 0}));
  ASSERT_EQ(shapes.size(), 3u);

  const BodyShape& ellipsoid = shapes[0];
  EXPECT_EQ(ellipsoid.body, 0);
  EXPECT_EQ(ellipsoid.kind, BodyShapeKind::kEllipsoid);
  EXPECT_EQ(ellipsoid.X_BS.p, M.p_BoG_B);
  EXPECT_GT(ellipsoid.X_BS.R.determinant(), 0);
  // The axes are in order of increasing moments, so tensors are compared.
  const auto tensor = [](const Eigen::Matrix3d& axes,
                         const Eigen::Vector3d& lengths) {
    return Eigen::Matrix3d(axes * lengths.cwiseAbs2().asDiagonal() *
                           axes.transpose());
  };
  const Eigen::Matrix3d expected = tensor(R, half_axes);
  EXPECT_LE((tensor(ellipsoid.X_BS.R, ellipsoid.size) - expected).norm(),
            Rounding(expected.norm(), 20));

  const BodyShape& bone = shapes[1];
  EXPECT_EQ(bone.body, 0);
  EXPECT_EQ(bone.kind, BodyShapeKind::kCapsule);
  EXPECT_DOUBLE_EQ(bone.size.y(), 0.3);
  const Eigen::Vector3d tip =
      bone.X_BS * Eigen::Vector3d(0, 0, bone.size.y() / 2);
  EXPECT_LE((tip - Eigen::Vector3d(0, 0.3, 0)).norm(), Rounding(0.3, 4));
  EXPECT_LE(
      (bone.X_BS.R.transpose() * bone.X_BS.R - Eigen::Matrix3d::Identity())
          .norm(),
      Rounding(1, 9));
  EXPECT_GT(bone.X_BS.R.determinant(), 0);

  EXPECT_EQ(shapes[2].body, 1);
  EXPECT_EQ(shapes[2].kind, BodyShapeKind::kEllipsoid);
}

TEST(RobotShapes, PrefersVisualsToCollisionsAndPlacesThemInTheBody) {
  RobotModel robot = Arm(EllipsoidInertia(3, {0.1, 0.1, 0.1}), {0, 0.3, 0});
  const int camera = *robot.tree.FindFrame("camera");
  robot.visuals.push_back({camera, {}, Box{{0.3, 0.2, 0.1}}, {1, 0, 0, 1}});
  robot.visuals.back().X_FS.p = {0.1, 0, 0};
  robot.collisions.push_back({camera, {}, Sphere{0.2}, {}});
  const auto shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].kind, BodyShapeKind::kBox);
  EXPECT_EQ(shapes[0].body, 0);
  EXPECT_EQ(shapes[0].size, Eigen::Vector3d(0.3, 0.2, 0.1));
  EXPECT_EQ(shapes[0].X_BS.p, Eigen::Vector3d(0.1, 0, 0.5));
  EXPECT_EQ(shapes[0].rgba, Eigen::Vector4d(1, 0, 0, 1));
}

TEST(RobotShapes, UsesCollisionsIfVisualsAreMeshes) {
  RobotModel robot = Arm(EllipsoidInertia(3, {0.1, 0.1, 0.1}), {0, 0.1, 0});
  robot.visuals.push_back({0, {}, Mesh{"a.stl", {1, 1, 1}}});
  robot.collisions.push_back({0, {}, Cylinder{0.1, 0.4}});
  robot.collisions.push_back({0, {}, Sphere{0.15}});
  const auto shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].kind, BodyShapeKind::kCylinder);
  EXPECT_EQ(shapes[0].size, Eigen::Vector3d(0.1, 0.4, 0));
  EXPECT_EQ(shapes[1].kind, BodyShapeKind::kEllipsoid);
  EXPECT_EQ(shapes[1].size, Eigen::Vector3d(0.15, 0.15, 0.15));
}

TEST(RobotShapes, AddsEllipsoidIfPrimitivesAreTooSmall) {
  RobotModel robot = Arm(EllipsoidInertia(3, {0.1, 0.1, 0.1}), {0, 0.3, 0});
  robot.visuals.push_back({0, {}, Box{{0.05, 0.05, 0.05}}});
  // The box has 125 cm3, the ellipsoid 4189 cm3. So the box is a sensor, and
  // the ellipsoid is drawn, too.
  EXPECT_EQ(MakeBodyShapes(robot).size(), 4u);
  robot.visuals.back().geometry = Box{{0.1, 0.1, 0.1}};
  EXPECT_EQ(MakeBodyShapes(robot).size(), 2u);
}

// The mesh is small for the inertia of its body. The second mesh of the same
// size shows that the first one is not all of the body.
TEST(RobotShapes, DrawsASmallMeshAlone) {
  RobotModel robot = Arm(EllipsoidInertia(3, {0.1, 0.1, 0.1}), {0, 0.3, 0});
  Mesh mesh{"a.stl", {1, 1, 1}};
  mesh.surface =
      std::make_shared<TriangleMesh>(BoxMesh({0, 0, 0}, {0.05f, 0.05f, 0.05f}));
  robot.visuals.push_back({0, {}, mesh});
  auto shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].kind, BodyShapeKind::kMesh);
  EXPECT_EQ(shapes[1].body, 1);
  robot.visuals.push_back({0, {}, Mesh{"missing.stl", {1, 1, 1}}});
  shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 4u);
  EXPECT_EQ(shapes[1].kind, BodyShapeKind::kEllipsoid);
  EXPECT_EQ(shapes[2].kind, BodyShapeKind::kCapsule);
}

TEST(RobotShapes, IgnoresShapesOfSizeZero) {
  RobotModel robot = Arm({}, {0, 0.001, 0});
  robot.collisions.push_back({0, {}, Sphere{0}});
  // Body 0 has no mass and too short a capsule, so it has no shapes.
  const auto shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 1u);
  EXPECT_EQ(shapes[0].body, 1);
}

TEST(RobotShapes, LimitsTheSizeOfEllipsoids) {
  Inertia needle;
  needle.mass = 1;
  needle.I_G_B = Eigen::Vector3d(0, 100, 100).asDiagonal();
  const auto shapes = MakeBodyShapes(Arm(needle, {0, 0.3, 0}));
  EXPECT_GE(shapes[0].size.minCoeff(), 0.004);
  EXPECT_LE(shapes[0].size.maxCoeff(), 0.4);
}

// The inertia of this body is that of a sphere of 0.38 m, but its joint is 5 cm
// from its center of mass, and the robot is small.
TEST(RobotShapes, ClampsEllipsoidsThatAreLargerThanTheRobot) {
  const auto shapes = MakeBodyShapes(
      Arm(EllipsoidInertia(1, {0.38, 0.38, 0.38}), {0, 0.05, 0}));
  EXPECT_LE(shapes[0].size.maxCoeff(), 0.05);
}

TEST(RobotShapes, DrawsMeshesThatHaveBeenRead) {
  RobotModel robot = Arm(EllipsoidInertia(3, {0.1, 0.1, 0.1}), {0, 0.3, 0});
  const auto surface = std::make_shared<TriangleMesh>(
      BoxMesh({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}));
  robot.visuals.push_back({0, {}, Mesh{"a.stl", {1, 1, 1}, surface}});
  robot.visuals.back().X_FS.p = {0.1, 0, 0};
  robot.collisions.push_back({0, {}, Cylinder{0.1, 0.4}});
  const auto shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].kind, BodyShapeKind::kMesh);
  EXPECT_EQ(shapes[0].mesh, surface);
  EXPECT_EQ(shapes[0].X_BS.p, Eigen::Vector3d(0.1, 0, 0));
}

// A shin of 0.3 m whose visual is a mesh that is missing. Its collision shape
// ends in its middle.
TEST(RobotShapes, FillsTheGapsThatMissingMeshesLeave) {
  RobotModel robot = Arm(EllipsoidInertia(3, {0.05, 0.1, 0.05}), {0, 0.3, 0});
  robot.collisions.push_back({0, {}, Box{{0.1, 0.16, 0.1}}});
  robot.collisions.back().X_FS.p = {0, 0.08, 0};
  EXPECT_EQ(MakeBodyShapes(robot).size(), 2u);  // There is no mesh.
  robot.visuals.push_back({0, {}, Mesh{"a.stl", {1, 1, 1}}});
  const auto shapes = MakeBodyShapes(robot);
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[1].kind, BodyShapeKind::kCapsule);
  EXPECT_DOUBLE_EQ(shapes[1].size.y(), 0.3);
  robot.collisions.back().geometry = Box{{0.1, 0.6, 0.1}};
  EXPECT_EQ(MakeBodyShapes(robot).size(), 2u);  // There is no gap.
}

}  // namespace
}  // namespace poise
