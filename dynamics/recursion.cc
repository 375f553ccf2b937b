// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/dynamics/recursion.h"

namespace poise {

Recursion::Recursion(const Tree& tree)
    : sine(tree.num_bodies()),
      cosine(tree.num_bodies()),
      R_WB(tree.num_bodies()),
      R_WP(tree.num_bodies()),
      p_PB_W(tree.num_bodies()),
      p_OB_W(tree.num_bodies()),
      turn_W(tree.num_bodies()),
      slide_W(tree.num_bodies()),
      w_WB(tree.num_bodies()),
      w_WP(tree.num_bodies()),
      alpha_WB(tree.num_bodies()),
      alpha_WP(tree.num_bodies()),
      a_WB(tree.num_bodies()),
      M_W(tree.num_bodies()),
      F_W(tree.num_bodies()),
      H_W(tree.num_bodies()),
      zero(Eigen::VectorXd::Zero(tree.nv())) {}

}  // namespace poise
