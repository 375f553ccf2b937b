// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "poise/sim/observation.h"

namespace poise {

/// The outcome of a run.
struct Verdict {
  bool recovered = false;
  /// Time at which the base or a foot first broke a rule of Judge, s. Empty if
  /// neither did, also if the final error of the CoM is too large.
  std::optional<double> fell_at;
  const char* fell_by = "";  ///< Cause of the fall, in words.
  Eigen::Vector3d com_error_peak = Eigen::Vector3d::Zero();   ///< m.
  Eigen::Vector3d com_error_final = Eigen::Vector3d::Zero();  ///< Signed, m.
  Eigen::Vector2d cop_peak = Eigen::Vector2d::Zero();         ///< m.
  double foot_tilt_peak = 0;                                  ///< rad.
  double foot_slide_peak = 0;                                 ///< m.
};

/// Judges by the plant's true state whether a robot recovered. It did if
/// - its center of mass was never below 60 % of its standing height, and its
///   base never tilted by more than 60 degrees;
/// - no foot that is meant to be down tilted by more than 0.1 rad or slid by
///   more than 30 mm; and
/// - the mean of com - com_ref over the last 0.5 s has a horizontal norm below
///   20 mm.
///
/// A robot that may take steps must also be at rest: in the last 0.5 s, all
/// feet are meant to be down, and its center of mass is slower than 0.02 m/s.
class Judge {
 public:
  static constexpr double kLowestCom = 0.6;  // Fraction of its height.
  static constexpr double kLargestTilt = 1.0471975511965976;  // 60 degrees.
  static constexpr double kLargestFootTilt = 0.1;
  static constexpr double kLargestSlide = 0.03;
  static constexpr double kLargestComError = 0.02;
  static constexpr double kEnd = 0.5;
  static constexpr double kAtRest = 0.02;  // m/s.

  /// @param standing_height  see StandingHeight(), m.
  /// @param steps            whether the robot may take steps.
  explicit Judge(double standing_height, bool steps = false)
      : standing_height_(standing_height), steps_(steps) {}

  void Look(const Observation& now);

  /// Returns whether the CoM is too low or the base too tilted. The run can
  /// stop then.
  bool is_down() const { return down_; }

  /// Returns whether Verdict::fell_at is set.
  bool has_fallen() const { return verdict_.fell_at.has_value(); }

  Verdict Conclude() const;

 private:
  void Fall(double time, const char* how);

  // One of the last ticks.
  struct LastTick {
    double time;
    Eigen::Vector3d error;  // com - com_ref, m.
    bool at_rest;
  };

  double standing_height_;
  bool steps_;
  bool down_ = false;
  Verdict verdict_;
  std::deque<LastTick> last_ticks_;
};

}  // namespace poise
