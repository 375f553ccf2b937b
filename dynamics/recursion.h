// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/body_arrays.h"
#include "poise/dynamics/tree.h"

namespace poise {

/// Recursion is the scratch memory of the recursions over a tree, shared by all
/// algorithms. A call reads only what the same call has written.
///
/// All vectors have world axes, and spatial vectors of a body are about its own
/// origin. From body to body vectors are shifted and never rotated. The
/// position of the world's origin is not used, so that long chains lose no
/// digits. Each array has one entry for each body, as a structure of arrays.
/// The sums from parent to child are sequential loops of few additions;
/// everything else is a loop with lanes, see
/// simd/README.md.
///
/// | member | size per body | meaning | point | filled by |
/// | sine, cosine | 1 | sine and cosine of the joint's angle | | SweepPoses |
/// | R_WB, R_WP | 3 x 3 | orientation, and the parent's | | SweepPoses |
/// | p_PB_W | 3 | position from the parent's origin | | SweepPoses |
/// | p_OB_W | 3 | position from the base's origin | | SweepPoses |
/// | turn_W, slide_W | 3 | velocity at unit joint rate | own | SweepPoses |
/// | w_WB, w_WP | 3 | angular velocity, the parent's | | SweepAccelerations |
/// | alpha_WB, alpha_WP | 3 | angular acceleration, the parent's | | as w_WB |
/// | a_WB | 3 | classical acceleration less gravity | own | as w_WB |
/// | M_W | 10 | mass moments of the body | own | SweepInertias |
/// |     |    | then mass moments of its subtree | own | SumInertias |
/// | F_W | 6 | force on the body at its acceleration | own | SweepForces |
/// |     |   | then force on its subtree | own | SumForces |
/// | H_W | 6 | subtree's momentum at unit joint rate | own | SweepMomenta |
/// | zero | (nv in all) | zeros | | the constructor |
struct Recursion {
  explicit Recursion(const Tree& tree);

  std::vector<double> sine, cosine;
  Mat3Array R_WB, R_WP;
  Vec3Array p_PB_W, p_OB_W;
  Vec3Array turn_W, slide_W;
  Vec3Array w_WB, w_WP;
  Vec3Array alpha_WB, alpha_WP;
  Vec3Array a_WB;
  MassMomentsArray M_W;
  Force3Array F_W;
  Force3Array H_W;
  Eigen::VectorXd zero;
};

}  // namespace poise
