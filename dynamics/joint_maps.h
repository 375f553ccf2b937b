// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

#include "poise/dynamics/body_arrays.h"

namespace poise {

/// JointMaps stores the constants of all joints as the recursions read them.
/// Entry B belongs to the joint that moves body B; entry 0, the base, has no
/// motion. The pose of body B in its parent P is
///     R_PB(q) = R_constant + R_sine sin q + R_cosine cos q,
///     p_PB(q) = p_PF + slide_P q,
/// and the joint adds the velocity
///     [turn_P; slide_P] q̇
/// to the velocity of P. A revolute joint has slide_P = 0. A prismatic joint
/// has turn_P = 0 and R_sine = R_cosine = 0. The formula has no branch on the
/// joint's type, axis or frame, so that loops over joints can use lanes.
struct JointMaps {
  explicit JointMaps(int num_bodies = 0)
      : parent(static_cast<size_t>(num_bodies)),
        end(parent.size()),
        R_constant(num_bodies),
        R_sine(num_bodies),
        R_cosine(num_bodies),
        p_PF(num_bodies),
        turn_P(num_bodies),
        slide_P(num_bodies),
        armature(parent.size()) {}

  std::vector<int> parent;  ///< Index of body P.
  std::vector<int> end;     ///< The subtree of B is bodies B ... end - 1.
  Mat3Array R_constant;
  Mat3Array R_sine;
  Mat3Array R_cosine;
  Vec3Array p_PF;
  Vec3Array turn_P;
  Vec3Array slide_P;
  std::vector<double> armature;
};

}  // namespace poise
