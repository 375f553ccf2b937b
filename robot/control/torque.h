// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/robot.h"

namespace poise {

/// Computes the joint torques that realise a solution y, (10):
///     tau = M_u v̇ + N_u - J_{c,u}' lambda.
///
/// @param y    [v̇ (nv); lambda (6 per foot)].
/// @param tau  by joint, N m or N.
/// Does not allocate.
void ComputeTorque(const Tick& tick, const std::vector<ContactTick>& contacts,
                   const Eigen::VectorXd& y, Eigen::VectorXd* tau) noexcept;

/// Computes the torques that overcome the damping d and the dry friction f of
/// the joints, which (10) does not contain:
///     d v + f tanh(a / a_0),
/// with the measured velocity v, and a the acceleration v̇ of the solution
/// after a low-pass filter. A joint that the friction holds gets the torque
/// against the friction, and a moving joint that lags behind gets more. The
/// sign of the measured velocity is not used: where the real friction is
/// smaller than f, such a torque would drive the joint. a_0 and the time of the
/// filter scale with the robot's pendulum.
class DragCompensation {
 public:
  explicit DragCompensation(const Robot& robot);

  /// Forgets the filtered accelerations.
  void Reset() noexcept;

  /// Adds the torques to tau, as far as they do not exceed the limits of the
  /// motors. Leaves tau as it is where a joint has neither damping nor
  /// friction.
  ///
  /// @param dt     control period, s.
  /// @param scale  factor on the limits.
  /// @param v      velocity of the joints, rad/s or m/s.
  /// @param vdot   acceleration of the joints, rad/s2 or m/s2.
  /// Does not allocate.
  void AddTo(double dt, double scale,
             const Eigen::Ref<const Eigen::VectorXd>& v,
             const Eigen::Ref<const Eigen::VectorXd>& vdot,
             Eigen::VectorXd* tau) noexcept;

 private:
  struct Drag {
    int joint;
    double damping, friction, effort;
    double acceleration = 0;  // Filtered, rad/s2 or m/s2.
  };
  std::vector<Drag> drags_;  // One for each joint with damping or friction.
  double small_;             // a_0.
  double filter_time_;       // s.
};

/// Returns the relative residual of a solution in the six unactuated rows of
/// the dynamics, (9): the sum over these rows of
///     | M_l v̇ + N_l - J_{c,l}' lambda |,
/// divided by the sum of the absolute values of all terms, or by `scale` if
/// that is larger. If the residual is above rounding, the torques of
/// ComputeTorque() belong to a motion that the robot cannot make. NaN if y is
/// not finite. Does not allocate.
double DynamicsResidual(const Tick& tick,
                        const std::vector<ContactTick>& contacts,
                        const Eigen::VectorXd& y, double scale) noexcept;

}  // namespace poise
