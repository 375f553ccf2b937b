// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

namespace poise {

/// Numbers that go to zero together, whatever is added on the way: each along
/// the curve of minimum jerk that leads from its value, rate and acceleration to
/// rest at zero in the time that is left; from rest, that of MinimumJerk. That is
/// the whole duration again whenever something is added. So what is added once is
/// gone after the duration, and what is added in every tick is filtered: it goes
/// with s^3 + 9/T s^2 + 36/T^2 s + 60/T^3, stable.
class Ramp {
 public:
  /// So many numbers, all zero. Allocates.
  void Resize(int size);

  /// Sets the duration of a ramp, s. With 0, offsets are dropped.
  void set_duration(double seconds) { duration_ = seconds; }
  double duration() const { return duration_; }

  /// A time dt has passed, s.
  void Advance(double dt) noexcept;
  void Add(int i, double jump) noexcept;
  void Clear() noexcept;

  bool is_on() const { return left_ > 0; }
  double operator[](int i) const { return x_(0, i); }

 private:
  Eigen::Matrix3Xd x_;  // Values, rates and accelerations.
  double duration_ = 0;
  double left_ = 0;  // Until all is zero, s.
};

}  // namespace poise
