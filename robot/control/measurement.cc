// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/measurement.h"

namespace poise {

bool IsBelievable(const Eigen::Ref<const Eigen::MatrixXd>& x) noexcept {
  constexpr double kLargest = 1e6;
  return x.allFinite() && x.lpNorm<Eigen::Infinity>() < kLargest;
}

}  // namespace poise
