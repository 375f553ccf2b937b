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

/// How a push goes over its duration T. All of them have the impulse of their
/// peak force F: F T for kBox, 2/pi F T for kHalfSine. kImpulse gives all F T
/// within one step.
enum class PushProfile { kBox, kHalfSine, kImpulse };

/// The name of a profile in files: "box", "half_sine" or "impulse".
const char* NameOf(PushProfile profile);

/// The axes in which a push's force and moment are given.
enum class PushFrame { kWorld, kLink };

/// A force and a moment on a link, of which the controller does not know.
struct Push {
  std::string link;  ///< Empty: the torso, see FindTorso().
  /// In the link's frame, m; where there is none, the center of mass of the
  /// body that the link belongs to.
  std::optional<Eigen::Vector3d> point;
  PushFrame frame = PushFrame::kWorld;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< Peak, N.
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< Peak, N m.
  PushProfile profile = PushProfile::kBox;
  double start = 1;        ///< s.
  double duration = 0.15;  ///< s.
};

/// Returns the mean of the push over [time, time + dt], divided by its peak. The
/// mean is exact for any dt, so that the impulse does not depend on the step.
double MeanOfProfile(const Push& push, double time, double dt);

/// The integral of a push's profile up to a time, s: its impulse, until then, is
/// this times its force.
double ProfileIntegral(const Push& push,
                       double until = std::numeric_limits<double>::infinity());

/// The impulse of a push up to a time, N s: ProfileIntegral() times the norm of
/// its peak force.
double ImpulseOf(const Push& push,
                 double until = std::numeric_limits<double>::infinity());

/// The push with the largest impulse up to a time, the first one of equals;
/// null where none has any.
const Push* LargestPush(const std::vector<Push>& pushes, double until);

/// A push on a robot, its link looked up.
class PushOnRobot {
 public:
  /// Throws std::invalid_argument if the robot has no such link, or a number is
  /// not finite, or the duration negative.
  PushOnRobot(const Robot& robot, const Push& push);

  /// Its mean over [time, time + dt], its body having the orientation R_WB;
  /// nothing where it does not act.
  std::optional<AppliedForce> At(double time, double dt,
                                 const Eigen::Matrix3d& R_WB) const;

  const Push& push() const { return push_; }
  int body() const { return body_; }
  const Eigen::Vector3d& p_BoQ_B() const { return p_BoQ_B_; }

  /// The peak force in the world's axes, or in its body's axes where it is
  /// given in its link's: then it turns with the body.
  Eigen::Vector3d force() const;

 private:
  Push push_;
  int body_;
  Eigen::Vector3d p_BoQ_B_;
  Eigen::Matrix3d R_BF_;
};

/// The heaviest body that is no part of a leg, which is what lies between the
/// base and a foot; the base counts as none.
int FindTorso(const Robot& robot);

}  // namespace poise
