// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/contact.h"

#include <Eigen/Geometry>

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

ContactTask::ContactTask(const std::vector<Foot>& feet)
    : Task("contact",
           FootRows(
               feet, "contact", RowKind::kTarget,
               {{"wx", "rad/s2", "the rotation of the % on the ground about x"},
                {"wy", "rad/s2", "the rotation of the % on the ground about y"},
                {"wz", "rad/s2", "the rotation of the % on the ground about z"},
                {"vx", "m/s2", "the motion of the % on the ground along x"},
                {"vy", "m/s2", "the motion of the % on the ground along y"},
                {"vz", "m/s2", "the motion of the % on the ground along z"}}),
           {}) {
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
}

void ContactTask::Write(const TaskInput& input, EqualityBlock* equalities,
                        InequalityBlock*) const noexcept {
  for (int i = 0; i < static_cast<int>(input.contacts.size()); ++i) {
    const ContactTick& contact = input.contacts[i];
    if (!contact.in_contact) continue;
    const Eigen::Matrix3d& R_WC = contact.X_WC.R;
    // z_C x z_W turns z_C upright; R' of a vector along z_W is its last row.
    const Eigen::Vector3d up_C = R_WC.row(2).transpose();
    const double height = contact.X_WC.p.z() - input.reference.ground_z;
    Vector6d e_C;
    e_C << Eigen::Vector3d::UnitZ().cross(up_C), -height * up_C;

    const auto nv = contact.J_WC_C.cols();
    equalities->B.block(6 * i, 0, 6, nv) = contact.J_WC_C;
    equalities->b.segment<6>(6 * i) =
        contact.Jdot_v_C + kd_ * contact.V_WC_C - kp_ * e_C;
  }
}

}  // namespace poise
