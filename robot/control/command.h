// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// How a tick ended.
enum class TickStatus {
  kOk,
  kLimitRelaxed,  ///< Solved; a torque or joint limit has slack.
  kTruncated,     ///< A level is not solved to 1e-9; the levels above are.
  kFailSafe,      ///< Gravity compensation and damping within the limits.
};

/// Output of the controller.
struct Command {
  Eigen::VectorXd tau;  ///< By joint, N m or N; within the effort limits.
  TickStatus status = TickStatus::kOk;
};

}  // namespace poise
