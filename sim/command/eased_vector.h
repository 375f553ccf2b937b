// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// A vector that goes from one target to the next with minimum jerk, and rests
/// at each. A new target may come before the last one is reached; the value,
/// the rate and the acceleration are continuous then as well.
class EasedVector {
 public:
  /// The vector at a time, and its derivatives by time.
  struct Motion {
    Eigen::Vector3d value, rate, acceleration;
  };

  EasedVector() = default;
  explicit EasedVector(const Eigen::Vector3d& start) : to_(start) {
    from_.value = start;
  }

  /// Goes to a target. The change begins at `time` and takes `over`, both in s.
  void GoTo(const Eigen::Vector3d& target, double time, double over);

  Motion At(double time) const;

 private:
  Motion from_ = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                  Eigen::Vector3d::Zero()};
  Eigen::Vector3d to_ = Eigen::Vector3d::Zero();
  double start_ = 0;
  double over_ = 1;
};

}  // namespace poise
