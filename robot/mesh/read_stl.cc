// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/read_stl.h"

#include <cstdint>
#include <cstring>
#include <optional>

#include "poise/robot/finding.h"
#include "poise/robot/mesh/mesh_words.h"

namespace poise {
namespace {

constexpr size_t kHeader = 80;
constexpr size_t kStart = 84;     // The first triangle is after the count.
constexpr size_t kTriangle = 50;  // Normal, 3 vertices, 2 bytes of attributes.
constexpr size_t kNormal = 12;

uint32_t LittleEndian(const char* bytes) {
  uint32_t value = 0;
  for (int i = 3; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

float FloatAt(const char* bytes) {
  const uint32_t bits = LittleEndian(bytes);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// Adds the triangle of the last three vertices.
void AddTriangle(TriangleMesh* mesh) {
  const int next = static_cast<int>(mesh->vertices.size());
  mesh->triangles.push_back({next - 3, next - 2, next - 1});
}

TriangleMesh ReadBinary(std::string_view bytes, const std::string& source) {
  if (bytes.size() < kStart) {
    throw Refusal(source, 0,
                  "is truncated: has " + std::to_string(bytes.size()) +
                      " bytes, an STL file has at least 84");
  }
  const size_t count = LittleEndian(bytes.data() + kHeader);
  const size_t present = (bytes.size() - kStart) / kTriangle;
  if (count > present) {
    throw Refusal(source, 0,
                  "is truncated or no STL file: has " +
                      std::to_string(present) + " triangles, must have " +
                      std::to_string(count));
  }
  if (count == 0) throw Refusal(source, 0, "has no triangles");
  TriangleMesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + kStart + kTriangle * i + kNormal;
    for (int k = 0; k < 3; ++k, at += 12) {
      const Eigen::Vector3f p(FloatAt(at), FloatAt(at + 4), FloatAt(at + 8));
      if (!p.allFinite()) {
        throw Refusal(source, 0,
                      "triangle " + std::to_string(i + 1) +
                          " has a coordinate that is not finite");
      }
      mesh.vertices.push_back(p);
    }
    AddTriangle(&mesh);
  }
  return mesh;
}

TriangleMesh ReadText(std::string_view text, const std::string& source) {
  TriangleMesh mesh;
  MeshWords words(text, source);
  size_t corners = 0;  // Corners of the current facet.
  while (const auto word = words.Next()) {
    if (*word == "vertex") {
      const float x = words.NextNumber(), y = words.NextNumber();
      mesh.vertices.emplace_back(x, y, words.NextNumber());
      if (++corners == 3) AddTriangle(&mesh);
      if (corners > 3) words.Refuse("a facet has more than 3 vertices");
    } else if (*word == "facet") {
      corners = 0;
      words.SkipLine();  // The normal.
    } else if (*word == "endfacet") {
      if (corners != 3) words.Refuse("a facet has fewer than 3 vertices");
    } else if (*word == "solid" || *word == "endsolid") {
      words.SkipLine();  // A name, which may be any text.
    } else if (*word != "outer" && *word != "loop" && *word != "endloop") {
      words.Refuse("unknown word " + Quoted(*word) + " in an STL file");
    }
  }
  if (mesh.triangles.empty()) throw Refusal(source, 0, "has no triangles");
  if (3 * mesh.triangles.size() != mesh.vertices.size()) {
    throw Refusal(source, 0, "is truncated: the last facet is not complete");
  }
  return mesh;
}

}  // namespace

TriangleMesh ReadStl(std::string_view bytes, const std::string& source) {
  const bool has_count =
      bytes.size() >= kStart &&
      bytes.size() ==
          kStart + kTriangle * size_t{LittleEndian(bytes.data() + kHeader)};
  const size_t start = bytes.find_first_not_of(" \t\r\n");
  const bool says_solid =
      start != std::string_view::npos && bytes.substr(start, 5) == "solid";
  return has_count || !says_solid ? ReadBinary(bytes, source)
                                  : ReadText(bytes, source);
}

}  // namespace poise
