// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// Brings a set of numbers to zero at the same time, even if a number is
/// increased on the way. Each number follows the minimum-jerk curve from its
/// value, rate and acceleration to rest at zero in the remaining time; from
/// rest, this is the curve of MinimumJerk. Any addition sets the remaining time
/// to the whole duration T again. A number that is added once is zero after T.
/// Numbers that are added in every tick are filtered; the characteristic
/// polynomial of the filter, s^3 + 9/T s^2 + 36/T^2 s + 60/T^3, is stable.
class Ramp {
 public:
  /// Sets the number of values, and all values to zero. Allocates.
  void Resize(int size);

  /// Sets the duration T of a ramp, s. With 0, Add() has no effect.
  void set_duration(double seconds) { duration_ = seconds; }
  double duration() const { return duration_; }

  /// Advances all values by a time dt, s.
  void Advance(double dt) noexcept;
  /// Adds `jump` to value i, and restarts the remaining time.
  void Add(int i, double jump) noexcept;
  void Clear() noexcept;

  bool is_on() const { return left_ > 0; }
  double operator[](int i) const { return x_(0, i); }

 private:
  Eigen::Matrix3Xd x_;  // Values, rates and accelerations.
  double duration_ = 0;
  double left_ = 0;  // Remaining time until all values are zero, s.
};

}  // namespace poise
