// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace poise {

/// PD gains on the center of mass, and integral gains against steady-state
/// error, see Disturbance.
struct ComGains {
  double kp = 30;         ///< 1/s2.
  double kd = 10;         ///< 1/s.
  double ki = 15;         ///< In the plane, 1/s3.
  double ki_height = 60;  ///< Along z, 1/s3.
};

}  // namespace poise
