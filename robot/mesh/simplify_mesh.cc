// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/simplify_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace poise {
namespace {

// The finest grid, relative to the mesh. It joins only vertices that are equal
// up to single precision. A coordinate of a cell has 20 bits.
constexpr double kFinest = 1e-6;

// Joins the vertices in each cell of a grid, and removes the triangles that
// then have no area. A closed surface remains closed.
TriangleMesh Join(const TriangleMesh& mesh, const Eigen::Vector3f& low,
                  double cell) {
  std::vector<std::pair<std::uint64_t, int>> order;
  order.reserve(mesh.vertices.size());
  for (const Eigen::Vector3f& p : mesh.vertices) {
    std::uint64_t key = 0;
    for (int i = 0; i < 3; ++i) {
      const double at = static_cast<double>(p[i] - low[i]) / cell;
      key = key << 21 | static_cast<std::uint64_t>(std::lround(at));
    }
    order.emplace_back(key, static_cast<int>(order.size()));
  }
  std::sort(order.begin(), order.end());
  TriangleMesh joined;
  std::vector<int> new_index(order.size());
  for (size_t i = 0; i < order.size();) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const size_t first = i;
    for (; i < order.size() && order[i].first == order[first].first; ++i) {
      sum += mesh.vertices[order[i].second].cast<double>();
      new_index[order[i].second] = static_cast<int>(joined.vertices.size());
    }
    const Eigen::Vector3d mean = sum / static_cast<double>(i - first);
    joined.vertices.push_back(mean.cast<float>());
  }
  for (std::array<int, 3> t : mesh.triangles) {
    for (int& corner : t) corner = new_index[corner];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    joined.triangles.push_back(t);
  }
  return joined;
}

double Area(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f ab = mesh.vertices[b] - mesh.vertices[a];
    area += 0.5 * ab.cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  }
  return area;
}

}  // namespace

TriangleMesh SimplifyMesh(const TriangleMesh& mesh,
                          std::size_t most_triangles) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : mesh.vertices) box.extend(p);
  if (box.isEmpty()) return mesh;
  const double size =
      std::max(static_cast<double>(box.diagonal().norm()), 1e-30);
  const double finest = kFinest * size;
  TriangleMesh joined = Join(mesh, box.min(), finest);
  if (joined.triangles.size() <= most_triangles) return joined;
  // A grid cuts a surface into about two triangles a cell.
  constexpr double kGrowth = 1.2;
  const double most = std::max(1.0, static_cast<double>(most_triangles));
  double cell = std::max(finest, std::sqrt(Area(joined) / most));
  for (; joined.triangles.size() > most_triangles && cell < 2 * size;
       cell *= kGrowth) {
    joined = Join(joined, box.min(), cell);
  }
  return joined;
}

}  // namespace poise
