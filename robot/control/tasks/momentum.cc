// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/tasks/momentum.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "math/so3.h"
#include "robot/control/tasks/row_names.h"
#include "robot/control/tasks/support_box.h"

namespace poise {
namespace {

// A reference is at least so far inside, m.
constexpr double kLeastWay = 0.01;

// Of the soles, in which the center of mass keeps while a foot is in the air.
constexpr double kMiddle = 0.5;

// Lower than this above its soles, a robot has fallen: no pendulum.
constexpr double kMinHeight = 0.05;  // m.

}  // namespace

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
      gravity_(tree.gravity_W().norm()),
      feet_(feet) {
  AddParameter("kp", &gains_.kp, 0, 1e4);
  AddParameter("kd", &gains_.kd, 0, 1e3);
  AddParameter("kd_angular", &kd_angular_, 0, 1e3);
  AddParameter("k_orientation", &k_orientation_, 0, 1e4);
  AddParameter("ki", &gains_.ki, 0, 100);
  AddParameter("ki_height", &gains_.ki_height, 0, 100);
  AddParameter("angular_weight", &angular_weight_, 1e-6, 1e6);
  AddParameter("feedforward", &feedforward_, 0, 1);
  AddParameter("capture", &capture_, 0, 1);
  AddParameter("capture_from", &capture_from_, 0, 10);
  AddParameter("capture_full", &capture_full_, 0, 10);
  AddParameter("capture_sideways", &capture_sideways_, 1, 10);
  AddParameter("capture_kp", &capture_kp_, 0, 1e4);
  AddParameter("capture_kd", &capture_kd_, 0, 1e3);
  AddParameter("capture_angular_weight", &capture_angular_weight_, 1e-6, 1e6);
  AddParameter("capture_height_weight", &capture_height_weight_, 1e-6, 1e6);
}

// Where the center of mass is to be: its reference, but over the feet that stand.
Eigen::Vector3d MomentumTask::ComReference(
    const TaskInput& input) const noexcept {
  int standing = 0;
  for (const ContactTick& contact : input.contacts) {
    standing += contact.in_contact ? 1 : 0;
  }
  if (standing == 0 || standing == static_cast<int>(feet_.size())) {
    return input.reference.p_WG;
  }
  const Pose X_WMid = MidFeet(input.contacts);
  const Pose X_MidW = X_WMid.Inverse();
  const auto reach = [&](SupportSide side) {
    return kMiddle * SupportReach(feet_, input.contacts, X_MidW, side);
  };
  Eigen::Vector3d p = X_MidW * input.reference.p_WG;
  p.x() = std::clamp(p.x(), -reach(kBack), reach(kFront));
  p.y() = std::clamp(p.y(), -reach(kRight), reach(kLeft));
  return X_WMid * p;
}

MomentumTask::CaptureShares MomentumTask::FindCapture(
    const TaskInput& input) const noexcept {
  const Tick& tick = input.tick;
  const Pose X_MidW = MidFeet(input.contacts).Inverse();
  const double height = std::max(kMinHeight, (X_MidW * tick.p_WG).z());
  const double w = std::sqrt(gravity_ / height);
  const Eigen::Vector3d k_W = tick.L_G.head<3>();
  const Eigen::Vector3d given_back_W =
      k_W.cross(Eigen::Vector3d::UnitZ()) / (mass_ * height);
  const Eigen::Vector3d xi =
      X_MidW * (tick.p_WG + (tick.v_WG + given_back_W) / w);
  const Eigen::Vector3d xi_ref =
      X_MidW * (ComReference(input) + input.reference.v_WG / w);

  const auto share = [&](SupportSide to, double farther) {
    const int axis = to == kFront || to == kBack ? 0 : 1;
    const int side = to == kFront || to == kLeft ? 1 : -1;
    const double reach = SupportReach(feet_, input.contacts, X_MidW, to);
    const double whole = std::max(kLeastWay, reach - side * xi_ref[axis]);
    const double way = side * (xi - xi_ref)[axis] / (farther * whole);
    const double least = 1e-3;  // Or the gains would jump.
    return capture_ *
           std::clamp((way - capture_from_) /
                          std::max(least, capture_full_ - capture_from_),
                      0.0, 1.0);
  };
  CaptureShares shares;
  shares.left = share(kLeft, capture_sideways_);
  shares.right = share(kRight, capture_sideways_);
  shares.all =
      std::max({shares.left, shares.right, share(kFront, 1), share(kBack, 1)});
  return shares;
}

void MomentumTask::Write(const TaskInput& input, EqualityBlock* equalities,
                         InequalityBlock*) const noexcept {
  const Tick& tick = input.tick;
  const Reference& reference = input.reference;
  const Eigen::Matrix3d& R_WB = tick.X_WB[0].R;
  const Eigen::Vector3d e_W = LogSo3(reference.R_WB * R_WB.transpose());

  // The height has its gains always: it does not fall over.
  const double share = input.capture;
  const double level_kp = gains_.kp + share * (capture_kp_ - gains_.kp);
  const double level_kd = gains_.kd + share * (capture_kd_ - gains_.kd);
  const Eigen::Array3d kp(level_kp, level_kp, gains_.kp);
  const Eigen::Array3d kd(level_kd, level_kd, gains_.kd);

  const Eigen::Array3d ahead = feedforward_ * reference.v_WG.array();
  Vector6d wanted;
  wanted << (k_orientation_ * e_W - kd_angular_ * tick.L_G.head<3>()) / mass_,
      (kp * (ComReference(input) - tick.p_WG).array() +
       kd * (ahead - tick.v_WG.array()))
              .matrix() +
          input.correction_W + feedforward_ * reference.a_WG;
  equalities->B.leftCols(tick.H_G.cols()) = tick.H_G / mass_;
  equalities->weight.head<3>().setConstant(
      angular_weight_ *
      std::pow(capture_angular_weight_ / angular_weight_, share));
  equalities->weight[5] = std::pow(capture_height_weight_, share);
  equalities->b = tick.H_G_bias / mass_ - wanted;
}

}  // namespace poise
