// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <chrono>
#include <cstddef>

#include "poise/robot/mesh/triangle_mesh.h"
#include "poise/robot/robot.h"

namespace poise {

/// Reads the mesh files of one robot. A file may have 128 MiB. All files
/// together may have 512 MiB and take 4 s. The memory is below 1 GiB.
class MeshReader {
 public:
  /// @param places  where the files are searched. Must live as long as the
  ///                reader.
  explicit MeshReader(const MeshPlaces& places) : places_(places) {}

  /// Returns a mesh in the axes of its shape, in m: the scale is applied. STL
  /// and OBJ files are read by ReadStl() and ReadObj(), others by
  /// ConvertMesh(). The extension tells the format.
  ///
  /// Throws Refusal if the file is missing, invalid or too large, or if a
  /// vertex is more than 10 m from the origin. The message is one line.
  TriangleMesh Read(const Mesh& mesh);

  /// Returns whether a mesh's file exists, see FindMesh().
  bool Finds(const Mesh& mesh) const;

 private:
  using Clock = std::chrono::steady_clock;

  double SecondsLeft() const;

  const MeshPlaces& places_;
  Clock::duration used_{0};
  std::size_t bytes_ = 0;
};

}  // namespace poise
