// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/torque.h"

namespace poise {

void ComputeTorque(const Tick& tick, const std::vector<ContactTick>& contacts,
                   const Eigen::VectorXd& y, Eigen::VectorXd* tau) noexcept {
  const auto nv = tick.M.rows();
  const auto n = tau->size();
  tau->noalias() = tick.M.bottomRows(n) * y.head(nv);
  *tau += tick.N.tail(n);
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
    if (!contacts[i].in_contact) continue;
    tau->noalias() -=
        contacts[i].J_WC_C.rightCols(n).transpose() * y.segment<6>(nv + 6 * i);
  }
}

}  // namespace poise
