// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/tasks/support_box.h"

#include <algorithm>
#include <cmath>

namespace poise {

double SupportReach(const std::vector<Foot>& feet,
                    const std::vector<ContactTick>& contacts,
                    const Pose& X_MidW, SupportSide side) noexcept {
  const int axis = side == kFront || side == kBack ? 0 : 1;
  const int sign = side == kFront || side == kLeft ? 1 : -1;
  // Distance of the farthest corner of a sole.
  double reach = -1;
  for (int i = 0; i < static_cast<int>(feet.size()); ++i) {
    if (!contacts[i].in_contact) continue;
    const Pose X_MidC = X_MidW * contacts[i].X_WC;
    const Eigen::Vector2d& half = feet[i].half_size;
    reach = std::max(reach, sign * X_MidC.p[axis] +
                                std::abs(X_MidC.R(axis, 0)) * half.x() +
                                std::abs(X_MidC.R(axis, 1)) * half.y());
  }
  return reach;
}

}  // namespace poise
