// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace poise {

/// A torque and a force on the point Q of a body, in world axes.
struct AppliedForce {
  int body;                  ///< Index in the tree; 0 is the base.
  Eigen::Vector3d p_BoQ_B;   ///< Point of application, m.
  Eigen::Vector3d torque_W;  ///< N m.
  Eigen::Vector3d force_W;   ///< N.
};

/// The plant's truth at one instant, all of it: no robot could measure it.
/// What acts during a step is its mean over the last step.
struct PlantState {
  double time = 0;       ///< s.
  Eigen::VectorXd q;     ///< See dynamics/tree.h.
  Eigen::VectorXd v;     ///< See dynamics/tree.h.
  Eigen::VectorXd vdot;  ///< Change of v over the last step, a second.
  Eigen::VectorXd tau;   ///< Torques after saturation, N m or N.
  /// By foot: the ground's wrench on it, about and in the axes of its contact
  /// frame C, [torque; force].
  std::vector<Eigen::Matrix<double, 6, 1>> F_Co_C;
  /// By foot: how many points of its sole bear a force.
  std::vector<int> contact_points;
  /// The ground's force on everything but the feet, N.
  Eigen::Vector3d other_force_W = Eigen::Vector3d::Zero();
  /// The pairs of bodies that press on each other, the smaller index first.
  std::vector<std::pair<int, int>> self_contacts;
};

/// A world with one robot in it: what stands in for the machine. A plant knows
/// neither a controller nor a scenario. It may allocate; it throws only from
/// its constructor.
class Plant {
 public:
  virtual ~Plant() = default;

  /// Puts the robot into the state (q, v) at time 0 and forgets all else: what
  /// follows depends on nothing that was before, to the bit.
  virtual void Reset(const Eigen::VectorXd& q, const Eigen::VectorXd& v) = 0;

  /// A force for the length of the next step; several add up.
  virtual void Apply(const AppliedForce& force) = 0;

  /// Advances by dt() under the joint torques tau, cut off at the effort
  /// limits.
  virtual void Step(const Eigen::VectorXd& tau) = 0;

  /// Returns the true state.
  virtual const PlantState& Sense() const = 0;

  virtual double dt() const = 0;
};

}  // namespace poise
