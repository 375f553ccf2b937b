// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/add_meshes.h"

#include <Eigen/Core>
#include <algorithm>
#include <set>
#include <string>

#include "poise/robot/mesh/read_visuals.h"
#include "poise/tools/commands/report/mesh_json.h"

namespace poise {
namespace {

using nlohmann::json;

// Returns the meshes of `unread` with their surfaces.
std::vector<Mesh> ReadAll(const json& unread, const MeshPlaces& places) {
  std::vector<Mesh> meshes;
  for (const json& mesh : unread) {
    const json& scale = mesh.at("scale");
    meshes.push_back(
        {mesh.at("file").get<std::string>(),
         Eigen::Vector3d(scale.at(0).get<double>(), scale.at(1).get<double>(),
                         scale.at(2).get<double>())});
  }
  std::vector<Mesh*> pointers;
  for (Mesh& mesh : meshes) pointers.push_back(&mesh);
  ReadSurfaces(places, pointers);
  return meshes;
}

}  // namespace

void AddMeshes(const std::vector<std::filesystem::path>& packages,
               json* robot) {
  if (!robot->is_object() || !robot->contains("unread_meshes")) return;
  try {
    const json& unread = robot->at("unread_meshes");
    const std::vector<Mesh> meshes =
        ReadAll(unread, {robot->at("urdf").get<std::string>(), packages});
    json added = json::array();
    std::set<json> bodies;
    for (size_t i = 0; i < meshes.size(); ++i) {
      if (meshes[i].surface == nullptr) continue;
      json shape = {{"kind", "mesh"}, {"size", {0, 0, 0}}};
      for (const char* key : {"body", "p", "quat", "rgba"}) {
        shape[key] = unread.at(i).at(key);
      }
      SetMesh(*meshes[i].surface, &shape);
      bodies.insert(shape["body"]);
      added.push_back(std::move(shape));
    }
    for (const json& shape : robot->at("shapes")) {
      if (shape.value("stand_in", false) && bodies.count(shape.at("body"))) {
        continue;
      }
      added.push_back(shape);
    }
    (*robot)["shapes"] = std::move(added);
  } catch (const json::exception&) {
    // Another program wrote the file. The page shows the robot as it is.
  }
}

}  // namespace poise
