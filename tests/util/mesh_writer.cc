// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/mesh_writer.h"

#include <cstdint>
#include <cstring>
#include <sstream>

namespace poise {
namespace {

template <typename Number>
void Append(Number value, std::string* bytes) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);  // The tests run little-endian.
  bytes->append(raw, sizeof value);
}

std::ostringstream Text() {
  std::ostringstream text;
  text.precision(9);  // Enough to read the same float again.
  return text;
}

}  // namespace

TriangleMesh BoxMesh(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(),
                               i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                    {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                    {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

std::string BinaryStl(const TriangleMesh& mesh, const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  Append(static_cast<std::uint32_t>(mesh.triangles.size()), &bytes);
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) Append(0.f, &bytes);  // The normal.
    for (const int corner : triangle) {
      for (int i = 0; i < 3; ++i) Append(mesh.vertices[corner][i], &bytes);
    }
    Append(std::uint16_t{0}, &bytes);
  }
  return bytes;
}

std::string TextStl(const TriangleMesh& mesh) {
  std::ostringstream text = Text();
  text << "solid a foot\n";
  for (const auto& triangle : mesh.triangles) {
    text << "  facet normal 0 0 0\n    outer loop\n";
    for (const int corner : triangle) {
      text << "      vertex " << mesh.vertices[corner].transpose() << "\n";
    }
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid a foot\n";
  return text.str();
}

std::string Obj(const TriangleMesh& mesh) {
  std::ostringstream text = Text();
  for (const Eigen::Vector3f& p : mesh.vertices) {
    text << "v " << p.transpose() << "\n";
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  }
  return text.str();
}

std::string Collada(const TriangleMesh& mesh, double meter,
                    const std::string& up_axis) {
  std::ostringstream text = Text();
  text << "<?xml version='1.0'?>\n<COLLADA xmlns='http://www.collada.org/2005/"
          "11/COLLADASchema' version='1.4.1'>\n<asset><unit meter='"
       << meter << "'/><up_axis>" << up_axis
       << "</up_axis></asset>\n<library_geometries><geometry id='g'><mesh>"
          "<source id='p'><float_array id='a' count='"
       << 3 * mesh.vertices.size() << "'>";
  for (const Eigen::Vector3f& p : mesh.vertices) text << p.transpose() << "\n";
  text << "</float_array><technique_common><accessor source='#a' count='"
       << mesh.vertices.size()
       << "' stride='3'><param name='X' type='float'/><param name='Y' "
          "type='float'/><param name='Z' type='float'/></accessor>"
          "</technique_common></source>\n<vertices id='v'><input "
          "semantic='POSITION' source='#p'/></vertices><triangles count='"
       << mesh.triangles.size()
       << "'><input semantic='VERTEX' source='#v' offset='0'/><p>";
  for (const auto& [a, b, c] : mesh.triangles) {
    text << a << " " << b << " " << c << " ";
  }
  text << "</p></triangles></mesh></geometry></library_geometries>\n"
          "<library_visual_scenes><visual_scene id='s'><node id='n'>"
          "<instance_geometry url='#g'/></node></visual_scene>"
          "</library_visual_scenes><scene><instance_visual_scene url='#s'/>"
          "</scene></COLLADA>\n";
  return text.str();
}

}  // namespace poise
