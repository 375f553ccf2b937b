// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// Numbers that decay to zero together. Each follows the minimum-jerk curve from its
/// value, rate and acceleration to rest at zero within the remaining time; from rest
/// this is MinimumJerk. Adding to the numbers restarts the remaining time. So a
/// single addition is gone after the duration T. Additions in every tick are
/// filtered, with the stable characteristic polynomial
/// s^3 + 9/T s^2 + 36/T^2 s + 60/T^3.
class Ramp {
 public:
  /// Sets the number of values, all zero. Allocates.
  void Resize(int size);

  /// Sets the duration of a ramp, s. With 0, offsets are dropped.
  void set_duration(double seconds) { duration_ = seconds; }
  double duration() const { return duration_; }

  /// Advances by the time dt, s.
  void Advance(double dt) noexcept;
  void Add(int i, double jump) noexcept;
  void Clear() noexcept;

  bool is_on() const { return left_ > 0; }
  double operator[](int i) const { return x_(0, i); }

 private:
  Eigen::Matrix3Xd x_;  // Values, rates and accelerations.
  double duration_ = 0;
  double left_ = 0;  // Remaining time, s.
};

}  // namespace poise
