// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/read_obj.h"

#include <charconv>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/mesh/mesh_words.h"
#include "poise/robot/text_file.h"

namespace poise {
namespace {

// Keeps the memory of a mesh far below 1 GiB.
constexpr std::size_t kMostTriangles = 8'000'000;

// Returns the vertex of a corner such as "7", "7/1", "7//3" or "-1/2/3",
// counted from 0.
int VertexOf(std::string_view corner, size_t num_vertices,
             const MeshWords& words) {
  const std::string_view number = corner.substr(0, corner.find('/'));
  const auto count = static_cast<long>(num_vertices);
  long index = 0;
  const char* end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, index);
  if (error != std::errc() || stop != end) {
    words.Refuse("corner of a face is " + Quoted(corner) +
                 ", must be the index of a vertex");
  }
  const long vertex = index < 0 ? count + index : index - 1;
  if (vertex < 0 || vertex >= count) {
    words.Refuse("corner of a face is " + Quoted(corner) + ", the file has " +
                 std::to_string(count) + " vertices before it");
  }
  return static_cast<int>(vertex);
}

void ReadFace(MeshWords* words, TriangleMesh* mesh) {
  std::array<int, 3> triangle{};
  int corners = 0;
  while (const auto corner = words->NextOfLine()) {
    if ((*corner)[0] == '#') {
      words->SkipLine();
      break;
    }
    const int vertex = VertexOf(*corner, mesh->vertices.size(), *words);
    if (corners >= 3) triangle[1] = triangle[2];
    triangle[corners < 2 ? corners : 2] = vertex;
    if (++corners >= 3) mesh->triangles.push_back(triangle);
    if (mesh->triangles.size() > kMostTriangles) {
      words->Refuse("the file has more than 8 million triangles");
    }
  }
  if (corners < 3) words->Refuse("a face has fewer than 3 corners");
}

// Removes the vertices that no triangle uses.
void RemoveUnused(TriangleMesh* mesh) {
  std::vector<int> new_index(mesh->vertices.size(), -1);
  std::vector<Eigen::Vector3f> used;
  for (std::array<int, 3>& triangle : mesh->triangles) {
    for (int& corner : triangle) {
      int& index = new_index[corner];
      if (index < 0) {
        index = static_cast<int>(used.size());
        used.push_back(mesh->vertices[corner]);
      }
      corner = index;
    }
  }
  mesh->vertices = std::move(used);
}

}  // namespace

TriangleMesh ReadObj(std::string_view text, const std::string& source) {
  ExpectText(text, source);
  TriangleMesh mesh;
  MeshWords words(text, source);
  while (const auto word = words.Next()) {
    if (*word == "v") {
      const float x = words.NextNumber(), y = words.NextNumber();
      mesh.vertices.emplace_back(x, y, words.NextNumber());
      words.SkipLine();  // A weight, or a color.
    } else if (*word == "f") {
      ReadFace(&words, &mesh);
    } else {
      words.SkipLine();
    }
  }
  if (mesh.vertices.empty()) throw Refusal(source, 0, "has no vertices");
  if (!mesh.triangles.empty()) RemoveUnused(&mesh);
  return mesh;
}

}  // namespace poise
