// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/contact.h"

#include <Eigen/Geometry>
#include <string_view>

#include "poise/robot/control/tasks/row_names.h"

namespace poise {

namespace {

// Bound on the acceleration of a motion with the share 1/2, as a fraction of
// gravity.
constexpr double kHalfLocked = 0.1;

// Returns six rows "right_foot.loop.1", ... for each foot but the first.
std::vector<RowDescription> LoopRows(const std::vector<Foot>& feet) {
  constexpr std::string_view kPhrase =
      "a motion of the % against the other foot";
  std::vector<RowDescription> rows;
  for (size_t i = 1; i < feet.size(); ++i) {
    AddFootRows(feet[i], "loop", RowKind::kLimit,
                {{"1", "m/s2", kPhrase},
                 {"2", "m/s2", kPhrase},
                 {"3", "m/s2", kPhrase},
                 {"4", "m/s2", kPhrase},
                 {"5", "m/s2", kPhrase},
                 {"6", "m/s2", kPhrase}},
                &rows);
  }
  return rows;
}

}  // namespace

ContactTask::ContactTask(const RobotModel& model, const std::vector<Foot>& feet)
    : Task("contact",
           FootRows(
               feet, "contact", RowKind::kTarget,
               {{"wx", "rad/s2", "the rotation of the % on the ground about x"},
                {"wy", "rad/s2", "the rotation of the % on the ground about y"},
                {"wz", "rad/s2", "the rotation of the % on the ground about z"},
                {"vx", "m/s2", "the motion of the % on the ground along x"},
                {"vy", "m/s2", "the motion of the % on the ground along y"},
                {"vz", "m/s2", "the motion of the % on the ground along z"}}),
           LoopRows(feet)),
      num_feet_(static_cast<int>(feet.size())),
      gravity_(model.tree.gravity_W().norm()) {
  for (size_t i = 0; i < feet.size(); ++i) {
    for (size_t k = i + 1; k < feet.size(); ++k) {
      loops_.emplace_back(model, feet[i].body, feet[k].body);
    }
  }
  AddParameter("kp", &kp_, 0, 1e4);
  AddParameter("kd", &kd_, 0, 1e3);
}

void ContactTask::Write(const TaskInput& input, EqualityBlock* equalities,
                        InequalityBlock* inequalities) const noexcept {
  int first = -1;  // The first foot in contact.
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
    if (first < 0) {
      first = i;
      continue;
    }
    LockedMotions locked;
    LoopOf(first, i).FindLocked(input.contacts[first], contact, &locked);
    LeaveOutLocked(locked, first, i, equalities, inequalities);
  }
}

const LoopClosure& ContactTask::LoopOf(int first, int second) const noexcept {
  const int before = first * (2 * num_feet_ - first - 1) / 2;
  return loops_[before + second - first - 1];
}

// Projects the rows of the first foot A and of foot B to those without n,
//     B <- B - metric n (n' B),
// and writes the rows of n as bounded ones.
void ContactTask::LeaveOutLocked(const LockedMotions& locked, int first,
                                 int second, EqualityBlock* equalities,
                                 InequalityBlock* inequalities) const noexcept {
  auto B_A = equalities->B.middleRows<6>(6 * first);
  auto B_B = equalities->B.middleRows<6>(6 * second);
  auto b_A = equalities->b.segment<6>(6 * first);
  auto b_B = equalities->b.segment<6>(6 * second);
  for (int k = 0; k < locked.count; ++k) {
    const int row = 6 * (second - 1) + k;
    const auto n_A = locked.n.col(k).head<6>(), n_B = locked.n.col(k).tail<6>();
    auto c = inequalities->C.row(row);
    c.noalias() = n_A.transpose() * B_A;
    c.noalias() += n_B.transpose() * B_B;
    const double d = n_A.dot(b_A) + n_B.dot(b_B);
    const Vector6d m_A = locked.metric.head<6>().cwiseProduct(n_A);
    const Vector6d m_B = locked.metric.tail<6>().cwiseProduct(n_B);
    B_A.noalias() -= m_A * c;
    B_B.noalias() -= m_B * c;
    b_A -= m_A * d;
    b_B -= m_B * d;
    const double share = locked.share[k];
    if (share == 1) {
      c.setZero();
      continue;
    }
    const double bound = kHalfLocked * gravity_ * share / (1 - share);
    inequalities->lower[row] = -bound - d;
    inequalities->upper[row] = bound - d;
  }
}

}  // namespace poise
