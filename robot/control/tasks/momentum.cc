// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/momentum.h"

#include <algorithm>
#include <cmath>

#include "poise/math/so3.h"
#include "poise/robot/control/tasks/row_names.h"

namespace poise {

MomentumTask::MomentumTask(const Tree& tree, const std::vector<Foot>& feet)
    : Task("momentum",
           AxisRows("momentum", RowKind::kTarget,
                    {{"kx", "N m", "the angular momentum about x"},
                     {"ky", "N m", "the angular momentum about y"},
                     {"kz", "N m", "the angular momentum about z"},
                     {"lx", "N", "the linear momentum along x"},
                     {"ly", "N", "the linear momentum along y"},
                     {"lz", "N", "the linear momentum along z"}}),
           {}),
      mass_(tree.total_mass() > 0 ? tree.total_mass() : 1),
      feet_(feet),
      trunk_(FindTrunk(tree, feet)),
      trunk_reference_(tree, trunk_) {
  AddParameter("kp", &gains_.kp, 0, 1e4);
  AddParameter("kd", &gains_.kd, 0, 1e3);
  AddParameter("kd_angular", &kd_angular_, 0, 1e3);
  AddParameter("k_orientation", &k_orientation_, 0, 1e6);
  AddParameter("ki", &gains_.ki, 0, 100);
  AddParameter("ki_height", &gains_.ki_height, 0, 100);
  AddParameter("angular_weight", &angular_weight_, 1e-6, 1e6);
  AddParameter("feedforward", &feedforward_, 0, 1);
  AddParameter("capture", &capture_.capture, 0, 1);
  AddParameter("capture_from", &capture_.from, 0, 10);
  AddParameter("capture_full", &capture_.full, 0, 10);
  AddParameter("capture_sideways", &capture_.sideways, 1, 10);
  AddParameter("capture_kp", &captured_.kp, 0, 1e4);
  AddParameter("capture_kd", &captured_.kd, 0, 1e3);
  AddParameter("capture_angular_weight", &captured_.angular_weight, 1e-6, 1e6);
  AddParameter("capture_height_weight", &captured_.height_weight, 1e-6, 1e6);
}

void MomentumTask::Write(const TaskInput& input, EqualityBlock* equalities,
                         InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  const Reference& reference = input.reference;
  const Eigen::Matrix3d& R_WT = tick.X_WB[trunk_].R;
  const Eigen::Vector3d e_W =
      LogSo3(trunk_reference_.Orientation(reference) * R_WT.transpose());

  // The height keeps its normal gains, because it is not unstable.
  const double share = input.capture;
  const double plane_kp = BlendByCapture(gains_.kp, captured_.kp, share);
  const double plane_kd = BlendByCapture(gains_.kd, captured_.kd, share);
  const Eigen::Array3d kp(plane_kp, plane_kp, gains_.kp);
  const Eigen::Array3d kd(plane_kd, plane_kd, gains_.kd);

  const Eigen::Array3d ahead = feedforward_ * reference.v_WG.array();
  const Eigen::Vector3d p_ref_WG =
      FindComTarget(feet_, input.contacts, reference);
  Vector6d wanted;
  wanted << (k_orientation_ * e_W - kd_angular_ * tick.L_G.head<3>()) / mass_,
      (kp * (p_ref_WG - tick.p_WG).array() + kd * (ahead - tick.v_WG.array()))
              .matrix() +
          input.correction_W + feedforward_ * reference.a_WG;
  const PendulumReference& pendulum = reference.pendulum;
  if (pendulum.is_on) {
    wanted.segment<2>(3) =
        pendulum.omega * pendulum.omega * (tick.p_WG.head<2>() - pendulum.p_WZ);
    wanted[5] = gains_.kp * (reference.p_WG.z() - tick.p_WG.z()) +
                gains_.kd * (reference.v_WG.z() - tick.v_WG.z()) +
                reference.a_WG.z() + input.correction_W.z();
    wanted[5] = std::min(wanted[5], pendulum.max_rise);
    equalities->B.leftCols(tick.H_G.cols()) = tick.H_G / mass_;
    equalities->weight.head<3>().setConstant(pendulum.angular_weight);
    equalities->weight[5] = pendulum.height_weight;
    equalities->b = tick.H_G_bias / mass_ - wanted;
    return;
  }
  equalities->B.leftCols(tick.H_G.cols()) = tick.H_G / mass_;
  equalities->weight.head<3>().setConstant(
      angular_weight_ *
      std::pow(captured_.angular_weight / angular_weight_, share));
  equalities->weight[5] = std::pow(captured_.height_weight, share);
  equalities->b = tick.H_G_bias / mass_ - wanted;
}

}  // namespace poise
