// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/simplify_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "poise/robot/mesh/read_stl.h"
#include "poise/tests/util/mesh_writer.h"

namespace poise {
namespace {

// Returns a sphere of radius 1 with 2 n (n - 1) triangles.
TriangleMesh Sphere(int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double polar = M_PI * i / n;
      const double around = 2 * M_PI * j / n;
      mesh.vertices.push_back(
          Eigen::Vector3d(std::sin(polar) * std::cos(around),
                          std::sin(polar) * std::sin(around), std::cos(polar))
              .cast<float>());
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = n * i + j, b = n * i + (j + 1) % n;
      if (i > 0) mesh.triangles.push_back({a, a + n, b});
      if (i < n - 1) mesh.triangles.push_back({b, a + n, b + n});
    }
  }
  return mesh;
}

// Returns six times the signed volume that a closed surface encloses.
double Volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a]
                  .cross(mesh.vertices[b])
                  .cast<double>()
                  .dot(mesh.vertices[c].cast<double>());
  }
  return volume;
}

TEST(SimplifyMesh, JoinsEqualVertices) {
  const TriangleMesh box = BoxMesh({0, 0, 0}, {1, 2, 3});
  const TriangleMesh separate = ReadStl(BinaryStl(box), "box");
  ASSERT_EQ(separate.vertices.size(), 36u);
  const TriangleMesh joined = SimplifyMesh(separate, 12);
  EXPECT_EQ(joined.vertices.size(), 8u);
  EXPECT_EQ(joined.triangles.size(), 12u);
  // Corners are counterclockwise as before.
  EXPECT_NEAR(Volume(joined), 6 * 6, 1e-5);  // Single precision.
}

TEST(SimplifyMesh, KeepsTheShapeWithFewTriangles) {
  const TriangleMesh sphere = Sphere(200);
  for (const size_t most : {300, 3000}) {
    const TriangleMesh simple = SimplifyMesh(sphere, most);
    EXPECT_LE(simple.triangles.size(), most);
    EXPECT_GT(simple.triangles.size(), most / 4);
    // A cell is at most about 1.4 * 2 / sqrt(most) of the size.
    const double cell = 10 / std::sqrt(static_cast<double>(most));
    for (const Eigen::Vector3f& p : simple.vertices) {
      EXPECT_NEAR(p.norm(), 1, cell);
    }
    EXPECT_GT(Volume(simple), 0.8 * 8 * M_PI);
    // The surface remains closed: each edge has a triangle on both sides.
    std::map<std::pair<int, int>, int> edges;
    for (const auto& t : simple.triangles) {
      for (int i = 0; i < 3; ++i) {
        ++edges[{t[i], t[(i + 1) % 3]}];
        --edges[{t[(i + 1) % 3], t[i]}];
      }
    }
    for (const auto& [edge, balance] : edges) EXPECT_EQ(balance, 0);
  }
}

TEST(SimplifyMesh, AcceptsMeshesWithoutSize) {
  EXPECT_TRUE(SimplifyMesh({}, 10).vertices.empty());
  TriangleMesh point;
  point.vertices.assign(3, {1, 2, 3});
  point.triangles = {{0, 1, 2}};
  EXPECT_EQ(SimplifyMesh(point, 10).triangles.size(), 0u);
  EXPECT_LE(SimplifyMesh(Sphere(20), 0).triangles.size(), 4u);
}

}  // namespace
}  // namespace poise
