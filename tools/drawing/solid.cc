// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/solid.h"

#include <Eigen/Geometry>
#include <cmath>

namespace poise {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kAround = 48;
constexpr int kRings = 12;  // Rings from a pole to the equator.

using Ring = std::vector<Eigen::Vector3d>;

void Add(const std::vector<Eigen::Vector3d>& corners,
         std::vector<Facet>* facets) {
  // Newell's formula also works if corners coincide, as at a pole.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += corners[i].cross(corners[(i + 1) % corners.size()]);
  }
  const double length = normal.norm();
  if (length > 0) facets->push_back({corners, normal / length});
}

Ring MakeRing(double radius, double z) {
  Ring ring;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * kPi * i / kAround;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return ring;
}

// Returns a surface of revolution about z, given by its rings from the lowest
// to the highest. A flat facet closes the first and the last ring.
std::vector<Facet> Revolve(const std::vector<Ring>& rings) {
  std::vector<Facet> facets;
  const Ring& bottom = rings.front();
  Add(Ring(bottom.rbegin(), bottom.rend()), &facets);
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    for (int i = 0; i < kAround; ++i) {
      const int j = (i + 1) % kAround;
      Add({rings[r][i], rings[r][j], rings[r + 1][j], rings[r + 1][i]},
          &facets);
    }
  }
  Add(rings.back(), &facets);
  return facets;
}

// Returns a cylinder with a half sphere on each end. The radius or the length
// may be 0; with length 0 the result is a sphere.
std::vector<Facet> MakeCapsule(double radius, double length) {
  std::vector<Ring> rings;
  for (int r = -kRings; r <= kRings; ++r) {
    const double latitude = kPi / 2 * r / kRings;
    const double z = radius * std::sin(latitude);
    const double around = radius * std::cos(latitude);
    if (r <= 0) rings.push_back(MakeRing(around, z - length / 2));
    if (r >= 0) rings.push_back(MakeRing(around, z + length / 2));
  }
  return Revolve(rings);
}

std::vector<Facet> MakeBox(const Eigen::Vector3d& size) {
  std::vector<Facet> facets;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      Ring corners;
      for (const auto& [a, b] :
           {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Eigen::Vector3d corner;
        corner[axis] = side * size[axis] / 2;
        corner[u] = a * side * size[u] / 2;
        corner[v] = b * size[v] / 2;
        corners.push_back(corner);
      }
      Add(corners, &facets);
    }
  }
  return facets;
}

std::vector<Facet> MakeMesh(const TriangleMesh& mesh) {
  std::vector<Facet> facets;
  for (const auto& triangle : mesh.triangles) {
    Ring corners;
    for (const int corner : triangle) {
      corners.push_back(mesh.vertices[corner].cast<double>());
    }
    Add(corners, &facets);
    Add(Ring(corners.rbegin(), corners.rend()), &facets);
  }
  return facets;
}

}  // namespace

std::vector<Facet> MakeFacets(const BodyShape& shape) {
  const Eigen::Vector3d& size = shape.size;
  switch (shape.kind) {
    case BodyShapeKind::kBox:
      return MakeBox(size);
    case BodyShapeKind::kCylinder:
      return Revolve({MakeRing(size.x(), -size.y() / 2),
                      MakeRing(size.x(), size.y() / 2)});
    case BodyShapeKind::kCapsule:
      return MakeCapsule(size.x(), size.y());
    case BodyShapeKind::kMesh:
      return MakeMesh(*shape.mesh);
    case BodyShapeKind::kEllipsoid:
      break;
  }
  std::vector<Facet> facets;
  for (const Facet& facet : MakeCapsule(1, 0)) {
    std::vector<Eigen::Vector3d> corners;
    for (const Eigen::Vector3d& corner : facet.corners) {
      corners.push_back(corner.cwiseProduct(size));
    }
    Add(corners, &facets);
  }
  return facets;
}

}  // namespace poise
