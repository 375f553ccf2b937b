// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/control/controller.h"
#include "poise/tests/util/decompositions.h"

namespace poise {

/// Solves the dynamics of a robot whose feet are bolted to the floor, for v̇
/// and the wrenches of the floor:
///     [ M  -J' ] [ v̇      ]   [ S' tau - N + f ]
///     [ J   0  ] [ lambda ] = [ -J̇ v           ].
/// This is an independent check: it uses the torques of the controller, but not
/// its solution.
class BoltedDown {
 public:
  explicit BoltedDown(const Controller& controller)
      : controller_(controller), tree_(controller.robot().model.tree) {}

  Eigen::VectorXd Solve(const Eigen::VectorXd& tau,
                        const Eigen::VectorXd& f) const {
    const Tick& tick = controller_.tick();
    const int nv = tree_.nv();
    const int feet = static_cast<int>(controller_.contacts().size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(nv + 6 * feet, nv + 6 * feet);
    Eigen::VectorXd k(nv + 6 * feet);
    K.topLeftCorner(nv, nv) = tick.M;
    k.head(nv) = f - tick.N;
    k.segment(tree_.v_start(), tree_.num_joints()) += tau;
    for (int i = 0; i < feet; ++i) {
      const ContactTick& contact = controller_.contacts()[i];
      K.block(0, nv + 6 * i, nv, 6) = -contact.J_WC_C.transpose();
      K.block(nv + 6 * i, 0, 6, nv) = contact.J_WC_C;
      k.segment<6>(nv + 6 * i) = -contact.Jdot_v_C;
    }
    return LeastSquaresSolution(K, k).x;
  }

 private:
  const Controller& controller_;
  const Tree& tree_;
};

}  // namespace poise
