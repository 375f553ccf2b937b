// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// The origin of a sole. kBox: boxes, cylinders or spheres of the foot. kMesh:
/// a mesh of the foot. kGuess: an estimate from the size of the leg.
enum class SoleSource { kBox, kMesh, kGuess };

/// Returns "box", "mesh" or "guess".
inline const char* NameOf(SoleSource source) {
  constexpr const char* kNames[] = {"box", "mesh", "guess"};
  return kNames[static_cast<int>(source)];
}

}  // namespace poise
