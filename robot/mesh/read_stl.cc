// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/mesh/read_stl.h"

#include <algorithm>
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

// Returns whether a word is `lower`, in any case of its letters.
bool Is(std::string_view word, std::string_view lower) {
  const auto same = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
  };
  return word.size() == lower.size() &&
         std::equal(word.begin(), word.end(), lower.begin(), same);
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
    if (Is(*word, "vertex")) {
      const float x = words.NextNumber(), y = words.NextNumber();
      mesh.vertices.emplace_back(x, y, words.NextNumber());
      if (++corners == 3) AddTriangle(&mesh);
      if (corners > 3) words.Refuse("a facet has more than 3 vertices");
    } else if (Is(*word, "facet")) {
      corners = 0;
      words.SkipLine();  // The normal.
    } else if (Is(*word, "endfacet")) {
      if (corners != 3) words.Refuse("a facet has fewer than 3 vertices");
    } else if (Is(*word, "solid") || Is(*word, "endsolid")) {
      words.SkipLine();  // A name, which may be any text.
    } else if (!Is(*word, "outer") && !Is(*word, "loop") &&
               !Is(*word, "endloop")) {
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
  if (has_count) return ReadBinary(bytes, source);
  for (const std::string_view mark : {"\xff\xfe", "\xfe\xff"}) {
    if (bytes.substr(0, 2) != mark) continue;
    throw Refusal(source, 0, "is a text in UTF-16, must be ASCII or UTF-8");
  }
  std::string_view text = bytes;
  const std::string_view mark = "\xef\xbb\xbf";  // Byte order mark of UTF-8.
  if (text.substr(0, mark.size()) == mark) text.remove_prefix(mark.size());
  const size_t start = text.find_first_not_of(" \t\r\n");
  const bool says_solid =
      start != std::string_view::npos && Is(text.substr(start, 5), "solid");
  // A binary file has zeros in its header or its count.
  const bool is_text =
      says_solid && text.substr(0, kStart).find('\0') == std::string_view::npos;
  return is_text ? ReadText(text, source) : ReadBinary(bytes, source);
}

}  // namespace poise
