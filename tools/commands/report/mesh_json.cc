// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/mesh_json.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace poise {
namespace {

template <typename Vectors>
std::string JoinNumbers(const Vectors& vectors) {
  std::string text;
  for (const auto& vector : vectors) {
    for (const auto number : vector) {
      text += (text.empty() ? "" : " ") + std::to_string(number);
    }
  }
  return text;
}

}  // namespace

void SetMesh(const TriangleMesh& mesh, nlohmann::json* shape) {
  constexpr double kPerMeter = 1e4;
  std::vector<std::array<long, 3>> vertices;
  for (const Eigen::Vector3f& p : mesh.vertices) {
    vertices.push_back({std::lround(kPerMeter * p.x()),
                        std::lround(kPerMeter * p.y()),
                        std::lround(kPerMeter * p.z())});
  }
  (*shape)["vertices"] = JoinNumbers(vertices);
  (*shape)["triangles"] = JoinNumbers(mesh.triangles);
}

}  // namespace poise
