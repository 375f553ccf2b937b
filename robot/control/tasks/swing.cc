// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/swing.h"

#include "poise/math/so3.h"
#include "poise/robot/control/tasks/row_names.h"

namespace poise {

SwingTask::SwingTask(const Foot& foot, int index)
    : Task("frame." + foot.name, FrameRows(foot.name), {}), index_(index) {
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
  AddParameter("step_kp", &step_kp_, 0, 1e4);
  AddParameter("step_kd", &step_kd_, 0, 1e3);
  AddParameter("step_orientation_weight", &step_orientation_weight_, 1e-6, 1e6);
  AddParameter("step_plane_weight", &step_plane_weight_, 1e-6, 1e6);
  AddParameter("step_height_weight", &step_height_weight_, 1e-6, 1e6);
}

bool SwingTask::HasRows(const TaskInput& input) const noexcept {
  const ContactTick& contact = input.contacts[index_];
  return !contact.in_contact && contact.is_guided;
}

void SwingTask::Write(const TaskInput& input, EqualityBlock* equalities,
                      InequalityBlock*) const noexcept {
  const ContactTick& foot = input.contacts[index_];
  const FrameReference& reference = input.reference.feet[index_];
  const double kp = foot.is_stepping ? step_kp_ : kp_;
  const double kd = foot.is_stepping ? step_kd_ : kd_;
  const Eigen::Matrix3d R_CW = foot.X_WC.R.transpose();
  Vector6d e_W;
  e_W << LogSo3(reference.X_WF.R * foot.X_WC.R.transpose()),
      reference.X_WF.p - foot.X_WC.p;
  const Vector6d wanted_W = reference.A_WF_W + kd * reference.V_WF_W + kp * e_W;
  Vector6d wanted_C;
  wanted_C << R_CW * wanted_W.head<3>(), R_CW * wanted_W.tail<3>();

  equalities->B.leftCols(foot.J_WC_C.cols()) = foot.J_WC_C;
  equalities->b = foot.Jdot_v_C + kd * foot.V_WC_C - wanted_C;
  if (!foot.is_stepping) return;
  equalities->weight << Eigen::Vector3d::Constant(step_orientation_weight_),
      step_plane_weight_, step_plane_weight_, step_height_weight_;
}

}  // namespace poise
