// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/dynamics/tree.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/robot.h"

namespace poise {

/// Settings of the capture blend. In profiles and task sets, these are
/// parameters of the task momentum: capture, capture_from, capture_full,
/// capture_sideways.
struct CaptureSettings {
  double capture = 1;      ///< Factor on all shares; 0 switches them off.
  double from = 0.65;      ///< Fraction of the way to the edge with share 0.
  double full = 1;         ///< Fraction of the way to the edge with share 1.
  double sideways = 1.25;  ///< Factor on the way to the left and right edges.
};

/// Result of a BalanceMonitor for one tick.
struct Balance {
  /// Capture point xi, corrected for the angular momentum, in the mid-feet
  /// frame, m.
  Eigen::Vector3d xi_Mid = Eigen::Vector3d::Zero();
  /// Capture blend, 0 to 1. 0: ankle torque alone can stop the robot. 1: the
  /// capture point is at the edge of support, and angular momentum is needed.
  /// The largest of the shares of the four sides.
  double capture = 0;
  double left = 0;   ///< Share of the left side.
  double right = 0;  ///< Share of the right side.

  /// The monitor's request to a foot.
  struct FootVerdict {
    bool is_released = false;  ///< The foot should be released if it is down.
    bool comes_back = false;   ///< The foot should be put down if released.
  };
  std::vector<FootVerdict> feet;  ///< By foot of the robot.
};

/// Computes how near the robot is to a fall, from its capture point. With G the
/// center of mass, h its height above the soles, m the mass and k the angular
/// momentum about G, in the mid-feet frame,
///     xi = p_G + (v_G + k x z / (m h)) / w,    w = sqrt(g / h).
/// The share of a side depends on the fraction of the way from the reference of
/// xi to the edge of the soles that xi has covered. The share grows linearly
/// from 0 at the fraction `from` to 1 at the fraction `full`.
///
/// A foot is released if the robot falls to the other side, the foot carries
/// almost no load, and another foot carries the robot. The leg of a released
/// foot can swing, and its mass takes up angular momentum. The foot comes back
/// once the robot is slow and upright, or falls to the side of the foot.
class BalanceMonitor {
 public:
  /// Thresholds hold for robot/models/humanoid.urdf; `scale` fits them to the
  /// robot.
  BalanceMonitor(const Tree& tree, const std::vector<Foot>& feet,
                 const FroudeScale& scale = {});

  /// Updates balance() with the state of this tick.
  /// @param contacts      poses of this tick, in_contact of the last one.
  /// @param normal_force  by foot, of the last solution, N.
  /// Does not allocate.
  void Update(const Tick& tick, const std::vector<ContactTick>& contacts,
              const Reference& reference, const CaptureSettings& settings,
              const Eigen::VectorXd& normal_force) noexcept;

  const Balance& balance() const { return balance_; }

 private:
  void FindShares(const Tick& tick, const std::vector<ContactTick>& contacts,
                  const Reference& reference,
                  const CaptureSettings& settings) noexcept;
  void JudgeFeet(const Tick& tick, const std::vector<ContactTick>& contacts,
                 const Reference& reference,
                 const Eigen::VectorXd& normal_force) noexcept;

  double mass_;       // kg.
  double gravity_;    // m/s2.
  double weight_;     // N.
  double least_way_;  // Lower bound on the way from xi_ref to an edge, m.
  double slow_;       // m/s.
  std::vector<Foot> feet_;
  Pose X_MidW_;
  Balance balance_;
};

/// Natural frequency w = sqrt(g / h) of the linear inverted pendulum, 1/s. The
/// height h is clamped to at least 0.05 m: below, the robot has fallen.
double PendulumFrequency(double gravity, double height) noexcept;

/// Returns the target of the center of mass in the world: the reference, which
/// is clamped to the middle half of the soles in contact while a foot is in the
/// air. Does not allocate.
Eigen::Vector3d FindComTarget(const std::vector<Foot>& feet,
                              const std::vector<ContactTick>& contacts,
                              const Reference& reference) noexcept;

/// Interpolates a gain or margin between its normal value (capture 0) and its
/// value for the largest pushes (capture 1).
inline double BlendByCapture(double normal, double captured, double capture) {
  return normal + capture * (captured - normal);
}

}  // namespace poise
