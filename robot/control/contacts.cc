// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/contacts.h"

#include <Eigen/Geometry>

#include "poise/math/so3.h"

namespace poise {

void ComputeContact(const FrameTick& frame, const Pose& X_FC,
                    ContactTick* out) noexcept {
  out->X_WC = frame.X_WF * X_FC;
  const Eigen::Matrix3d R_CW = out->X_WC.R.transpose();
  const Eigen::Vector3d p_FC_W = frame.X_WF.R * X_FC.p;

  // V_WC_C = X V_WF_W, X = [ R_CW 0; -R_CW [p]x  R_CW ].
  Eigen::Matrix<double, 6, 6> X;
  X.topLeftCorner<3, 3>() = R_CW;
  X.topRightCorner<3, 3>().setZero();
  X.bottomLeftCorner<3, 3>().noalias() = -R_CW * Hat(p_FC_W);
  X.bottomRightCorner<3, 3>() = R_CW;

  const Eigen::Vector3d w = frame.V_WF_W.head<3>();
  out->V_WC_C.noalias() = X * frame.V_WF_W;
  out->J_WC_C.noalias() = X.lazyProduct(frame.J_WF_W);
  out->Jdot_v_C.noalias() = X * frame.Jdot_v;
  out->Jdot_v_C.tail<3>() += R_CW * w.cross(w.cross(p_FC_W));
}

Pose MidFeet(const std::vector<ContactTick>& contacts) noexcept {
  bool any = false;
  for (const ContactTick& contact : contacts) any |= contact.in_contact;
  Pose X_WMid;
  Eigen::Vector3d x_W = Eigen::Vector3d::Zero();
  int count = 0;
  for (const ContactTick& contact : contacts) {
    if (any && !contact.in_contact) continue;
    X_WMid.p += contact.X_WC.p;
    x_W += contact.X_WC.R.col(0);
    ++count;
  }
  if (count > 0) X_WMid.p /= count;
  x_W.z() = 0;
  if (x_W.norm() < 1e-6) return X_WMid;  // No heading.
  X_WMid.R.col(0) = x_W.normalized();
  X_WMid.R.col(1) = Eigen::Vector3d::UnitZ().cross(X_WMid.R.col(0));
  X_WMid.R.col(2) = Eigen::Vector3d::UnitZ();
  return X_WMid;
}

}  // namespace poise
