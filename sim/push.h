// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/plants/plant.h"

namespace poise {

/// Time profile of a push of duration T and peak force F. The impulse is F T
/// for kBox and 2/pi F T for kHalfSine. kImpulse applies all of F T within one
/// step.
enum class PushProfile { kBox, kHalfSine, kImpulse };

/// Returns the name of a profile in files: "box", "half_sine" or "impulse".
const char* NameOf(PushProfile profile);

/// The axes in which a push's force and moment are given.
enum class PushFrame { kWorld, kLink };

/// A force and a moment on a link. The controller receives no information about
/// a push.
struct Push {
  std::string link;  ///< Empty: the torso, see FindTorso().
  /// Point where the force acts, in the link's frame, m. Empty: the center of
  /// mass of the body that the link belongs to.
  std::optional<Eigen::Vector3d> point;
  PushFrame frame = PushFrame::kWorld;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< Peak, N.
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< Peak, N m.
  PushProfile profile = PushProfile::kBox;
  double start = 1;        ///< s.
  double duration = 0.15;  ///< s.
  /// Impulse as a fraction of Yardstick::lipm_height_Ns at the start of the
  /// push. If it is given, `force` only has the direction.
  std::optional<double> impulse_fraction;
  /// Replaces impulse_fraction on any robot but Scenario::chosen_for.
  std::optional<double> elsewhere;
};

/// Gives a push this peak force instead of a fraction of a bound.
void SetForce(const Eigen::Vector3d& force, Push* push);

/// Returns the mean of the push over [time, time + dt], divided by its peak.
/// The mean is exact for any dt, so that the impulse does not depend on the
/// step.
double MeanOfProfile(const Push& push, double time, double dt);

/// Returns the integral of a push's profile up to a time, s. The impulse up to
/// that time is the integral times the peak force.
double ProfileIntegral(const Push& push,
                       double until = std::numeric_limits<double>::infinity());

/// Returns the impulse of a push up to a time, N s: ProfileIntegral() times the
/// norm of the peak force.
double ImpulseOf(const Push& push,
                 double until = std::numeric_limits<double>::infinity());

/// Returns the push with the largest impulse up to a time, the first of equals.
/// Null if no push has an impulse by then.
const Push* LargestPush(const std::vector<Push>& pushes, double until);

/// Returns whether a push does nothing: its duration is 0, or its force and
/// moment are.
bool IsZero(const Push& push);

/// Returns the time from the end of the last push to a time, s. Pushes that
/// have not begun by then, and those that are zero, do not count. Negative if a
/// push is active at that time; infinite if no push counts.
double TimeAfterPushes(const std::vector<Push>& pushes, double until);

/// A push on a robot, with its link resolved to a body.
class PushOnRobot {
 public:
  /// Throws std::invalid_argument if the robot has no such link, a number is
  /// not finite, or the duration is negative.
  PushOnRobot(const Robot& robot, const Push& push);

  /// Returns the mean of the push over [time, time + dt], for a body with the
  /// orientation R_WB. Empty if the push is not active in this interval.
  std::optional<AppliedForce> At(double time, double dt,
                                 const Eigen::Matrix3d& R_WB) const;

  const Push& push() const { return push_; }
  int body() const { return body_; }
  const Eigen::Vector3d& p_BoQ_B() const { return p_BoQ_B_; }

  /// Returns the peak force, N. It is in world axes, or in the body's axes if
  /// the push is given in the link's axes; then the force turns with the body.
  Eigen::Vector3d force() const;

 private:
  Push push_;
  int body_;
  Eigen::Vector3d p_BoQ_B_;
  Eigen::Matrix3d R_BF_;
};

/// Returns the heaviest body that is not part of a leg. A leg is the chain from
/// the base, without the base, to a foot.
int FindTorso(const Robot& robot);

}  // namespace poise
