// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/tasks/momentum.h"

#include "math/so3.h"
#include "robot/control/tasks/row_names.h"

namespace poise {

MomentumTask::MomentumTask(const Tree& tree)
    : Task("momentum",
           AxisRowNames("momentum", {"kx", "ky", "kz", "lx", "ly", "lz"}), {}),
      mass_(tree.total_mass() > 0 ? tree.total_mass() : 1) {
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
  AddParameter("kd_angular", &kd_angular_, 0, 1e3);
  AddParameter("k_orientation", &k_orientation_, 0, 1e4);
  AddParameter("ki", &ki_, 0, 100);
  AddParameter("ki_height", &ki_height_, 0, 100);
  AddParameter("angular_weight", &angular_weight_, 1e-6, 1e6);
  AddParameter("feedforward", &feedforward_, 0, 1);
}

void MomentumTask::Write(const TaskInput& input, EqualityBlock* equalities,
                         InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  const Reference& reference = input.reference;
  const Eigen::Matrix3d& R_WB = tick.X_WB[0].R;
  const Eigen::Vector3d e_W = LogSo3(reference.R_WB * R_WB.transpose());

  Vector6d wanted;
  wanted << (k_orientation_ * e_W - kd_angular_ * tick.L_G.head<3>()) / mass_,
      kp_ * (reference.p_WG - tick.p_WG) - kd_ * tick.v_WG +
          input.correction_W +
          feedforward_ * (kd_ * reference.v_WG + reference.a_WG);
  equalities->B.leftCols(tick.H_G.cols()) = tick.H_G / mass_;
  equalities->weight.head<3>().setConstant(angular_weight_);
  equalities->b = tick.H_G_bias / mass_ - wanted;
}

}  // namespace poise
