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

/// Shape of a push over its duration T. With the peak force F, the impulse is F T for
/// kBox and 2/pi F T for kHalfSine. kImpulse applies F T within one step.
enum class PushProfile { kBox, kHalfSine, kImpulse };

/// Returns the name of a profile in files: "box", "half_sine" or "impulse".
const char* NameOf(PushProfile profile);

/// The axes in which a push's force and moment are given.
enum class PushFrame { kWorld, kLink };

/// A force and a moment on a link, unknown to the controller.
struct Push {
  std::string link;  ///< Empty: the torso, see FindTorso().
  /// Point of application in the link's frame, m. Without a value, the center of mass
  /// of the link's body.
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

/// Returns the integral of a push's profile up to a time, s. The impulse up to then is
/// the integral times the peak force.
double ProfileIntegral(const Push& push,
                       double until = std::numeric_limits<double>::infinity());

/// Returns the impulse of a push up to a time, N s: ProfileIntegral() times the norm of
/// its peak force.
double ImpulseOf(const Push& push,
                 double until = std::numeric_limits<double>::infinity());

/// Returns the push with the largest impulse up to a time, the first of equal ones;
/// null if all are zero.
const Push* LargestPush(const std::vector<Push>& pushes, double until);

/// A push on the link of a robot.
class PushOnRobot {
 public:
  /// Throws std::invalid_argument if the robot has no such link, or a number is
  /// not finite, or the duration negative.
  PushOnRobot(const Robot& robot, const Push& push);

  /// Returns the mean force over [time, time + dt] for the orientation R_WB of the body;
  /// empty if the push does not act.
  std::optional<AppliedForce> At(double time, double dt,
                                 const Eigen::Matrix3d& R_WB) const;

  const Push& push() const { return push_; }
  int body() const { return body_; }
  const Eigen::Vector3d& p_BoQ_B() const { return p_BoQ_B_; }

  /// Returns the peak force in world axes, or in body axes if the push is given in link
  /// axes and rotates with the body.
  Eigen::Vector3d force() const;

 private:
  Push push_;
  int body_;
  Eigen::Vector3d p_BoQ_B_;
  Eigen::Matrix3d R_BF_;
};

/// Returns the heaviest body that is not part of a leg. A leg is the chain between
/// base and foot without the base.
int FindTorso(const Robot& robot);

}  // namespace poise
