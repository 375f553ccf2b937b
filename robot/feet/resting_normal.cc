// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/resting_normal.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

namespace poise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using Triangle = std::array<Vector3d, 3>;

double Cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Returns whether a triangle, seen from above and counterclockwise, contains a
// point.
bool Contains(const Triangle& triangle, const Vector2d& point) {
  for (int i = 0; i < 3; ++i) {
    const Vector2d a = triangle[i].head<2>();
    const Vector2d b = triangle[(i + 1) % 3].head<2>();
    if (Cross(b - a, point - a) < 0) return false;
  }
  return true;
}

// Returns the point farthest below the plane through `origin`, or null if no
// point is below the plane.
const Vector3d* Lowest(const std::vector<Vector3d>& points,
                       const Vector3d& normal, const Vector3d& origin) {
  constexpr double kBelow = 1e-7;  // m. Files have single precision.
  double lowest = normal.dot(origin) - kBelow;
  const Vector3d* found = nullptr;
  for (const Vector3d& p : points) {
    const double height = normal.dot(p);
    if (height >= lowest) continue;
    lowest = height;
    found = &p;
  }
  return found;
}

// Returns the up normal of the plane that is below all points and highest at
// `center`.
//
// This linear program in three variables has three points as its basis. The
// point farthest below their plane replaces one of the three, so that the
// center remains inside their triangle (dual simplex method). The first three
// points are around all others, and so high that they are below no facet with a
// slope below 10.
std::optional<Vector3d> NormalBelow(const std::vector<Vector3d>& points,
                                    const Vector2d& center, double size) {
  constexpr int kMostSteps = 100;
  const double far = 10 * size;
  const double high = 10 * far;
  Triangle basis;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * M_PI * i / 3;
    basis[i] << center + far * Vector2d(std::cos(angle), std::sin(angle)), high;
  }
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector3d normal =
        (basis[1] - basis[0]).cross(basis[2] - basis[0]).normalized();
    if (!(normal.z() > 0)) return std::nullopt;
    const Vector3d* below = Lowest(points, normal, basis[0]);
    if (below == nullptr) {
      for (const Vector3d& p : basis) {
        if (p.z() >= high) return std::nullopt;
      }
      return normal;
    }
    bool is_replaced = false;
    for (int i = 0; i < 3 && !is_replaced; ++i) {
      Triangle next = basis;
      next[i] = *below;
      is_replaced = Contains(next, center);
      if (is_replaced) basis = next;
    }
    if (!is_replaced) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vector3d> RestingNormal(const Outline& outline,
                                      const Vector3d& up_B, bool only_meshes) {
  Eigen::Matrix3d R_UB;  // U has z up.
  R_UB.row(0) = up_B.unitOrthogonal();
  R_UB.row(1) = up_B.cross(R_UB.row(0).transpose());
  R_UB.row(2) = up_B;
  std::vector<Vector3d> points;
  Eigen::AlignedBox3d box;
  for (const Outline::Corner& corner : outline.corners) {
    if (only_meshes && !corner.is_mesh) continue;
    points.push_back(R_UB * (corner.p_B - corner.radius * up_B));
    box.extend(points.back());
  }
  if (points.empty()) return std::nullopt;
  for (Vector3d& p : points) p.z() -= box.min().z();
  const auto normal_U =
      NormalBelow(points, box.center().head<2>(), box.diagonal().norm());
  if (!normal_U) return std::nullopt;
  return R_UB.transpose() * *normal_U;
}

}  // namespace poise
