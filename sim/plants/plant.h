// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "poise/math/eigen_alignment.h"

namespace poise {

/// A torque and a force on the point Q of a body, in world axes.
struct AppliedForce {
  int body;                  ///< Index in the tree; 0 is the base.
  Eigen::Vector3d p_BoQ_B;   ///< Point of application, m.
  Eigen::Vector3d torque_W;  ///< N m.
  Eigen::Vector3d force_W;   ///< N.
};

/// Complete true state of the plant at one instant; sensors measure only a
/// part. Forces and torques are means over the last step.
struct PlantState {
  double time = 0;       ///< s.
  Eigen::VectorXd q;     ///< See dynamics/tree.h.
  Eigen::VectorXd v;     ///< See dynamics/tree.h.
  Eigen::VectorXd vdot;  ///< Change of v over the last step, divided by dt.
  Eigen::VectorXd tau;   ///< Torques after saturation, N m or N.
  /// By foot: wrench of the ground on the foot, [torque; force], about the
  /// origin and in the axes of the contact frame C, N m and N.
  std::vector<Eigen::Matrix<double, 6, 1>> F_Co_C;
  /// By foot: number of points of the sole that carry a load.
  std::vector<int> contact_points;
  /// Force of the ground on all bodies except the feet, N.
  Eigen::Vector3d other_force_W = Eigen::Vector3d::Zero();
  /// Pairs of bodies that press on each other, the smaller index first.
  std::vector<std::pair<int, int>> self_contacts;
};

/// A simulated world with one robot, in place of a real robot. A plant does not
/// depend on a controller or a scenario. Its members may allocate. Only the
/// constructor throws.
class Plant {
 public:
  virtual ~Plant() = default;

  /// Puts the robot into the state (q, v) at time 0. Nothing from before
  /// Reset() affects the following steps, so they repeat to the bit.
  virtual void Reset(const Eigen::VectorXd& q, const Eigen::VectorXd& v) = 0;

  /// Adds a force that acts during the next step only. Several forces add up.
  virtual void Apply(const AppliedForce& force) = 0;

  /// Advances by dt() under the joint torques tau, N m or N, which are clamped
  /// to the effort limits.
  virtual void Step(const Eigen::VectorXd& tau) = 0;

  /// Returns the true state.
  virtual const PlantState& Sense() const = 0;

  virtual double dt() const = 0;
};

}  // namespace poise
