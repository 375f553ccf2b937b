// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/simd/lanes.h"

namespace poise {

/// The joints as the recursions take them, by the body B that each one moves;
/// the entries of the base, body 0, are those of a joint that cannot move.
/// The pose of B in its parent P is
///     R_PB(q) = R_constant + R_sine sin q + R_cosine cos q,
///     p_PB(q) = p_PF + slide_P q,
/// and its velocity at q̇ is [turn_P; slide_P] q̇ more than P's: a revolute joint
/// has slide_P = 0, a prismatic one turn_P = 0 and R_sine = R_cosine = 0. One
/// formula, without a branch, for every type, axis and frame.
struct JointMaps {
  explicit JointMaps(int num_bodies = 0)
      : parent(num_bodies),
        end(num_bodies),
        R_constant(num_bodies),
        R_sine(num_bodies),
        R_cosine(num_bodies),
        p_PF(num_bodies),
        turn_P(num_bodies),
        slide_P(num_bodies),
        armature(num_bodies) {}

  std::vector<int> parent;  ///< Body P.
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
