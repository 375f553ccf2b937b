// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/torque.h"

#include <algorithm>
#include <cmath>

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

double DynamicsResidual(const Tick& tick,
                        const std::vector<ContactTick>& contacts,
                        const Eigen::VectorXd& y, double scale) noexcept {
  const auto nv = tick.M.rows();
  double off = 0, terms = 0;
  for (int row = 0; row < 6; ++row) {
    double left = tick.N[row];
    terms += std::abs(left);
    const auto add = [&left, &terms](double term) {
      left += term;
      terms += std::abs(term);
    };
    for (Eigen::Index i = 0; i < nv; ++i) add(tick.M(i, row) * y[i]);
    for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
      if (!contacts[i].in_contact) continue;
      for (int k = 0; k < 6; ++k) {
        add(-contacts[i].J_WC_C(k, row) * y[nv + 6 * i + k]);
      }
    }
    off += std::abs(left);
  }
  return off / std::max(scale, terms);
}

}  // namespace poise
