// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/solid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Area, vector area (zero if the surface is closed) and volume of a surface, by
// the divergence theorem.
struct Measures {
  double area = 0;
  Eigen::Vector3d closure = Eigen::Vector3d::Zero();
  double volume = 0;
};

Measures Measure(const BodyShape& shape) {
  Measures measures;
  for (const Facet& facet : MakeFacets(shape)) {
    EXPECT_LE(std::abs(facet.normal.norm() - 1), Rounding(1, 3));
    for (std::size_t i = 2; i < facet.corners.size(); ++i) {
      const Eigen::Vector3d twice =
          (facet.corners[i - 1] - facet.corners[0])
              .cross(facet.corners[i] - facet.corners[0]);
      EXPECT_GE(twice.dot(facet.normal), 0);
      measures.area += twice.norm() / 2;
      measures.closure += twice / 2;
      measures.volume += facet.corners[0].dot(twice) / 6;
    }
    // The shape is convex and contains the origin, so every normal must point
    // away from the origin.
    EXPECT_GT(facet.normal.dot(facet.corners[0]), 0);
  }
  return measures;
}

BodyShape Shape(BodyShapeKind kind, const Eigen::Vector3d& size) {
  return {0, {}, kind, size, Eigen::Vector4d::Ones()};
}

// Expects a value slightly below the exact one. The facets lie inside the exact
// surface; with 48 around the axis, they lose less than 1 %.
void ExpectNearBelow(double value, double exact) {
  EXPECT_LT(value, exact);
  EXPECT_GT(value, 0.99 * exact);
}

TEST(Solid, BoxIsExact) {
  const Measures box = Measure(Shape(BodyShapeKind::kBox, {0.2, 0.3, 0.5}));
  EXPECT_LE(std::abs(box.volume - 0.03), Rounding(0.03, 36));
  EXPECT_LE(std::abs(box.area - 0.62), Rounding(0.62, 36));
  EXPECT_LE(box.closure.norm(), Rounding(0.62, 36));
}

TEST(Solid, CylinderIsClosedAndHasTheRightVolume) {
  const Measures cylinder =
      Measure(Shape(BodyShapeKind::kCylinder, {0.1, 0.4, 0}));
  ExpectNearBelow(cylinder.volume, kPi * 0.01 * 0.4);
  ExpectNearBelow(cylinder.area, 2 * kPi * 0.1 * (0.4 + 0.1));
  EXPECT_LE(cylinder.closure.norm(), Rounding(cylinder.area, 200));
}

TEST(Solid, CapsuleIsClosedAndHasTheRightVolume) {
  const Measures capsule =
      Measure(Shape(BodyShapeKind::kCapsule, {0.1, 0.4, 0}));
  ExpectNearBelow(capsule.volume, kPi * 0.01 * (0.4 + 4.0 / 3 * 0.1));
  EXPECT_LE(capsule.closure.norm(), Rounding(capsule.area, 3000));
}

TEST(Solid, EllipsoidIsClosedAndHasTheRightVolume) {
  const Measures ellipsoid =
      Measure(Shape(BodyShapeKind::kEllipsoid, {0.1, 0.2, 0.3}));
  ExpectNearBelow(ellipsoid.volume, 4.0 / 3 * kPi * 0.006);
  EXPECT_LE(ellipsoid.closure.norm(), Rounding(ellipsoid.area, 3000));
}

// Each triangle of a mesh is drawn from both sides.
TEST(Solid, MeshHasBothSidesOfEachTriangle) {
  BodyShape shape = Shape(BodyShapeKind::kMesh, Eigen::Vector3d::Zero());
  shape.mesh = std::make_shared<TriangleMesh>(
      BoxMesh({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}));
  const auto facets = MakeFacets(shape);
  ASSERT_EQ(facets.size(), 24u);
  for (std::size_t i = 0; i < facets.size(); i += 2) {
    EXPECT_EQ(facets[i].normal, -facets[i + 1].normal);
    // The first side is the outer side, as in the mesh.
    EXPECT_GT(facets[i].normal.dot(facets[i].corners[0]), 0);
  }
}

}  // namespace
}  // namespace poise
