// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <string_view>

#include "poise/robot/mesh/read_obj.h"
#include "poise/robot/mesh/read_stl.h"
#include "poise/tests/fuzz/fuzzing.h"

namespace {

using poise::Require;

void Check(const poise::TriangleMesh& mesh) {
  Require(!mesh.vertices.empty(), "a mesh has vertices");
  for (const Eigen::Vector3f& p : mesh.vertices) {
    Require(p.allFinite(), "vertices are finite");
  }
  const int count = static_cast<int>(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      Require(corner >= 0 && corner < count, "corners are vertices");
    }
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  poise::ExpectReadsOrRefuses([&] {
    const poise::TriangleMesh mesh = poise::ReadStl(bytes, "fuzzed");
    Check(mesh);
    Require(mesh.triangles.size() <= size, "no triangle without text");
  });
  poise::ExpectReadsOrRefuses([&] {
    const poise::TriangleMesh mesh = poise::ReadObj(bytes, "fuzzed");
    Check(mesh);
    Require(mesh.triangles.size() <= size, "no triangle without text");
  });
  return 0;
}
