// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/simd/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/vector6.h"

namespace poise {

/// What a control tick needs of one frame F: `frame`, an index into
/// Tree::frames(), is the constructor's, the rest ComputeTick()'s.
///
/// | member | shape | meaning | axes, point |
/// | X_WF | pose | of the frame | world |
/// | V_WF_W | 6 | its velocity [w; v], J_WF_W v | world, F's origin |
/// | J_WF_W | 6 x nv | its Jacobian | world, F's origin |
/// | Jdot_v | 6 | its classical acceleration at v̇ = 0 | world, F's origin |
struct FrameTick {
  int frame;
  Pose X_WF;
  Vector6d V_WF_W;
  Matrix6Xd J_WF_W;
  Vector6d Jdot_v;
};

/// Everything that one control tick needs of the dynamics, computed in one call
/// by ComputeTick(). Nobody else writes it. SI units; angular before linear. M,
/// N and J are those of the paper's (7), J and Jdot_v of (11), c of (17), H_G and
/// H_G_bias of (19).
///
/// | member | shape | meaning | axes, point | computed from |
/// | M | nv x nv | joint-space inertia, symmetric to the bit | as v | q |
/// | N | nv | bias with gravity: M v̇ + N = S' tau + J' lambda | as v | q, v |
/// | c | nv | the same without gravity | as v | q, v |
/// | X_WB | bodies | pose of each body | world | q |
/// | p_WG | 3 | center of mass G | world | q |
/// | v_WG | 3 | its velocity | world | q, v |
/// | H_G | 6 x nv | centroidal momentum matrix | world, G | q |
/// | H_G_bias | 6 | d/dt L_G = H_G v̇ + H_G_bias | world, G | q, v |
/// | L_G | 6 | centroidal momentum, H_G v | world, G | q, v |
/// | frames | those asked for | see FrameTick | | q, v |
///
/// Six numbers here are columns and right sides of a controller's equations, as
/// J v̇ + Jdot_v, so they are plain vectors: SpatialMotion(V_WF_W) or
/// SpatialMomentum(L_G) is what they stand for.
struct Tick {
  /// For the frames of the given indices; allocates all there is to allocate.
  Tick(const Tree& tree, const std::vector<int>& frames);

  Eigen::MatrixXd M;
  Eigen::VectorXd N;
  Eigen::VectorXd c;
  std::vector<Pose> X_WB;
  Eigen::Vector3d p_WG;
  Eigen::Vector3d v_WG;
  Matrix6Xd H_G;
  Vector6d H_G_bias;
  Vector6d L_G;
  std::vector<FrameTick> frames;

 private:
  friend void ComputeTick(const Tree& tree,
                          const Eigen::Ref<const Eigen::VectorXd>& q,
                          const Eigen::Ref<const Eigen::VectorXd>& v,
                          Tick* tick) noexcept;

  Recursion recursion_;
};

/// Fills tick for the state (q, v), see Tree, in four steps: the equation of
/// motion, the poses of the bodies, the centroidal dynamics and the frames. Their
/// equations stand above them in tick.cc. Costs O(n depth): 3.6 us for 50 joints
/// and two feet, two times RNEA alone. Does not allocate, does not throw.
void ComputeTick(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 Tick* tick) noexcept;

}  // namespace poise
