// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/read_visuals.h"

#include <algorithm>
#include <memory>
#include <variant>

#include "poise/robot/finding.h"
#include "poise/robot/mesh/find_mesh.h"
#include "poise/robot/mesh/mesh_reader.h"
#include "poise/robot/mesh/simplify_mesh.h"

namespace poise {

int ReadVisuals(RobotModel* model) {
  std::vector<Mesh*> meshes;
  for (Shape& shape : model->visuals) {
    if (auto* mesh = std::get_if<Mesh>(&shape.geometry)) meshes.push_back(mesh);
  }
  return ReadSurfaces(model->mesh_places, meshes);
}

int ReadSurfaces(const MeshPlaces& places, const std::vector<Mesh*>& meshes) {
  constexpr size_t kMostTriangles = 24'000;
  constexpr size_t kFewest = 60;  // Per mesh. Fewer show no shape.
  const auto exists = [&](const Mesh* mesh) {
    return !FindMesh(places, mesh->file).path.empty();
  };
  const auto found =
      static_cast<size_t>(std::count_if(meshes.begin(), meshes.end(), exists));
  const size_t share = kMostTriangles / std::max<size_t>(1, found);
  MeshReader reader(places);
  size_t triangles = 0;
  int missing = 0;
  for (Mesh* mesh : meshes) {
    try {
      if (triangles > kMostTriangles) throw Refusal(mesh->file, 0, "");
      auto surface = std::make_shared<TriangleMesh>(
          SimplifyMesh(reader.Read(*mesh), std::max(kFewest, share)));
      triangles += surface->triangles.size();
      if (!surface->triangles.empty()) mesh->surface = std::move(surface);
    } catch (const Refusal&) {
      // The mesh has stand-ins, see MakeBodyShapes() of the drawing.
    }
    if (mesh->surface == nullptr) ++missing;
  }
  return missing;
}

}  // namespace poise
