// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/command/lean_path.h"

#include "poise/math/so3.h"

namespace poise {

void LeanPath::LeanTo(const Eigen::Vector3d& lean_W, double time, double over) {
  lean_W_.GoTo(lean_W, time, over);
  leans_ |= !lean_W.isZero(0);
}

void LeanPath::Write(double time, Reference* reference) const {
  if (leans_) reference->R_WB = ExpSo3(lean_W_.At(time).value) * start_R_WB_;
}

}  // namespace poise
