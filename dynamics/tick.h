// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/pose.h"
#include "poise/math/vector6.h"

namespace poise {

/// FrameTick holds what a control tick needs of one frame F. The constructor of
/// Tick sets `frame`, an index into Tree::frames(); ComputeTick() fills the
/// rest.
///
/// | member | shape | meaning | axes, point |
/// | X_WF | pose | pose of the frame | world |
/// | V_WF_W | 6 | velocity [w; v] of the frame, J_WF_W v | world, F's origin |
/// | J_WF_W | 6 x nv | Jacobian of the frame | world, F's origin |
/// | Jdot_v | 6 | classical acceleration at v̇ = 0 | world, F's origin |
struct FrameTick {
  int frame;
  Pose X_WF;
  Vector6d V_WF_W;
  Matrix6Xd J_WF_W;
  Vector6d Jdot_v;
};

/// Tick holds all dynamics of one control tick. Only ComputeTick() writes it.
/// SI units; angular before linear. The paper defines M, N and J in (7), J and
/// Jdot_v in (11), c in (17), and H_G and H_G_bias in (19).
///
/// | member | shape | meaning | axes, point | computed from |
/// | M | nv x nv | joint-space inertia, symmetric to the bit | as v | q |
/// | N | nv | bias with gravity: M v̇ + N = S' tau + J' lambda | as v | q, v |
/// | c | nv | bias without gravity | as v | q, v |
/// | X_WB | bodies | pose of each body | world | q |
/// | p_WG | 3 | center of mass G | world | q |
/// | v_WG | 3 | velocity of G | world | q, v |
/// | H_G | 6 x nv | centroidal momentum matrix | world, G | q |
/// | H_G_bias | 6 | d/dt L_G = H_G v̇ + H_G_bias | world, G | q, v |
/// | L_G | 6 | centroidal momentum, H_G v | world, G | q, v |
/// | frames | one per frame index | see FrameTick | | q, v |
///
/// Spatial vectors are plain vectors of six here, because a controller uses
/// them in equations such as J v̇ + Jdot_v. SpatialMotion(V_WF_W) and
/// SpatialMomentum(L_G) convert them.
struct Tick {
  /// Makes a tick with the frames of these indices, and allocates all its
  /// memory.
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
/// motion, the poses of the bodies, the centroidal dynamics and the frames.
/// Each step has its equations above it in tick.cc. Costs O(n depth): 3.6 us
/// for 50 joints and two feet, two times RNEA alone. Does not allocate, does
/// not throw.
void ComputeTick(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 Tick* tick) noexcept;

}  // namespace poise
