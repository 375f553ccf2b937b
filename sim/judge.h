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
  /// Time of the first failure, s; empty if the failure is at the end only.
  std::optional<double> fell_at;
  const char* fell_by = "";  ///< Cause of the fall, in words.
  Eigen::Vector3d com_error_peak = Eigen::Vector3d::Zero();   ///< m.
  Eigen::Vector3d com_error_final = Eigen::Vector3d::Zero();  ///< Signed, m.
  Eigen::Vector2d cop_peak = Eigen::Vector2d::Zero();         ///< m.
  double foot_tilt_peak = 0;                                  ///< rad.
  double foot_slide_peak = 0;                                 ///< m.
};

/// Decides from the plant's true state whether a robot recovered. The base was
/// always above 60 % of its standing height and tilted by less than 60 degrees. No
/// foot that is planned to be down tilted by more than 0.1 rad or slid by more than
/// 30 mm. The mean of com - com_ref over the last half second is less than 20 mm in
/// the plane.
class Judge {
 public:
  static constexpr double kLowestBase = 0.6;
  static constexpr double kLargestTilt = 1.0471975511965976;  // 60 degrees.
  static constexpr double kLargestFootTilt = 0.1;
  static constexpr double kLargestSlide = 0.03;
  static constexpr double kLargestComError = 0.02;
  static constexpr double kEnd = 0.5;

  /// @param standing_height  height of the base above the ground, m.
  explicit Judge(double standing_height) : standing_height_(standing_height) {}

  void Look(const Observation& now);

  /// Returns whether the robot lies or is about to, so that the run can end.
  bool is_down() const { return down_; }

  /// Returns whether Verdict::fell_at has a value.
  bool has_fallen() const { return verdict_.fell_at.has_value(); }

  Verdict Conclude() const;

 private:
  void Fall(double time, const char* how);

  struct ComError {
    double time;
    Eigen::Vector3d error;
  };

  double standing_height_;
  bool down_ = false;
  Verdict verdict_;
  std::deque<ComError> last_errors_;
};

}  // namespace poise
