// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// Facts about the feet that a profile gives. They replace a search.
struct FeetHints {
  /// The bodies of the left and of the right foot.
  std::optional<std::array<int, 2>> feet;
  /// The forward direction, a unit vector along an axis of the root link. It
  /// has no effect if it is vertical or points from foot to foot.
  std::optional<Eigen::Vector3d> forward_B;
};

}  // namespace poise
