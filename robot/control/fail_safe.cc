// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/fail_safe.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace poise {

void ComputeFailSafeTorque(const Tick& tick,
                           const std::vector<ContactTick>& contacts,
                           const Eigen::Ref<const Eigen::VectorXd>& v_joints,
                           double damping, Eigen::VectorXd* tau) noexcept {
  const auto n = tau->size();
  const auto start = tick.M.rows() - n;
  *tau = (tick.N - tick.c).tail(n);

  // lambda_0 = J_l (J_l' J_l)^-1 g_l, foot by foot.
  Matrix6d gram = Matrix6d::Zero();
  bool standing = false;
  for (const ContactTick& contact : contacts) {
    if (!contact.in_contact || start < 6) continue;
    const Matrix6d J_l = contact.J_WC_C.leftCols<6>();
    gram.noalias() += J_l.transpose() * J_l;
    standing = true;
  }
  if (standing) {
    const Vector6d g_l = tick.N.head<6>() - tick.c.head<6>();
    const Vector6d share = gram.ldlt().solve(g_l);
    for (const ContactTick& contact : contacts) {
      if (!contact.in_contact) continue;
      const Vector6d lambda = contact.J_WC_C.leftCols<6>() * share;
      tau->noalias() -= contact.J_WC_C.rightCols(n).transpose() * lambda;
    }
  }

  for (Eigen::Index j = 0; j < n; ++j) {
    if (!std::isfinite(v_joints[j])) continue;
    (*tau)[j] -= damping * tick.M(start + j, start + j) * v_joints[j];
  }
}

}  // namespace poise
