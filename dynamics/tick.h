// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/recursion.h"
#include "dynamics/tree.h"
#include "math/pose.h"
#include "math/vector6.h"

namespace poise {

/// What a control tick needs of one frame F, in world axes.
struct FrameTick {
  int frame;        ///< Index into Tree::frames().
  Pose X_WF;        ///< Its pose.
  Vector6d V_WF_W;  ///< [w; v of its origin].
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_WF_W;  ///< V_WF_W = J_WF_W v.
  Vector6d Jdot_v;  ///< Its acceleration at v̇ = 0 (classical, not spatial).
};

/// Everything that one control tick needs of the dynamics, computed in one call
/// by ComputeTick(). Nobody else writes it.
///
/// | member | shape | meaning |
/// | M | nv x nv | joint-space inertia, symmetric to the bit |
/// | N | nv | bias forces with gravity: M v̇ + N = S' tau + J' lambda |
/// | c | nv | the same without gravity |
/// | X_WB | bodies | pose of each body |
/// | p_WG, v_WG | 3 | center of mass and its velocity |
/// | H_G | 6 x nv | centroidal momentum matrix, angular first, world axes |
/// | H_G_bias | 6 | d/dt L_G = H_G v̇ + H_G_bias |
/// | L_G | 6 | centroidal momentum, H_G v |
/// | frames | those asked for | see FrameTick |
struct Tick {
  /// For the frames of the given indices; allocates all there is to allocate.
  Tick(const Tree& tree, const std::vector<int>& frames);

  Eigen::MatrixXd M;
  Eigen::VectorXd N;
  Eigen::VectorXd c;
  std::vector<Pose> X_WB;
  Eigen::Vector3d p_WG;
  Eigen::Vector3d v_WG;
  Eigen::Matrix<double, 6, Eigen::Dynamic> H_G;
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

/// Fills tick for the state (q, v), see Tree. Does not allocate, does not
/// throw.
void ComputeTick(const Tree& tree, const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& v,
                 Tick* tick) noexcept;

}  // namespace poise
