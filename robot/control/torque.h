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
/// the joints, (10) does not contain them:
///     d v + f h,  h = g + (1 - |g|) tanh(v̇ / a_0),  g = tanh(v / v_0),
/// with the measured velocity v and the acceleration v̇ of the solution. A joint
/// at rest gets the torque against the friction that its motion will meet.
/// |h| < 1, so with a correct f the torque never exceeds the friction and moves
/// no joint by itself. v_0 and a_0 scale with the time constant of the robot's
/// pendulum.
class DragCompensation {
 public:
  explicit DragCompensation(const Robot& robot);

  /// Adds the torques to tau, as far as they do not exceed the limits of the
  /// motors. Leaves tau as it is where a joint has neither damping nor friction.
  ///
  /// @param scale  factor on the limits.
  /// @param v     velocity of the joints, rad/s or m/s.
  /// @param vdot  acceleration of the joints, rad/s2 or m/s2.
  /// Does not allocate.
  void AddTo(double scale, const Eigen::Ref<const Eigen::VectorXd>& v,
             const Eigen::Ref<const Eigen::VectorXd>& vdot,
             Eigen::VectorXd* tau) const noexcept;

 private:
  struct Drag {
    int joint;
    double damping, friction, effort;
  };
  std::vector<Drag> drags_;  // Of the joints that have damping or friction.
  double velocity_, acceleration_;  // v_0 and a_0.
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
