// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/robot/gait/turn_strength.h"

namespace poise {

/// Box around the support of the feet, m, in the mid-feet frame.
struct SupportBox {
  double front = 0, back = 0, left = 0, right = 0;  ///< All positive.
};

/// How far the capture point goes, as a fraction of the way from the middle of
/// the support to its edge.
struct EdgeFractions {
  double sagittal = 0;  ///< To the front or back edge.
  double lateral = 0;   ///< To the left or right edge.
  double beyond = 0;    ///< Distance beyond the farther of these edges, m.
};

/// Predicts the capture point at the end of a push, with the CoP kept at the
/// best place inside the box. In each axis, the pendulum with the acceleration
/// a of the push and the CoP p has
///     xi(T) = p + (xi - p) exp(w T) + a / w^2 (exp(w T) - 1).
/// The best CoP brings xi nearest to the middle.
///
/// @param xi_Mid  present capture point, m.
/// @param a_Mid   acceleration of G by the push, m/s2.
/// @param omega   w, 1/s.
/// @param T       time until the end of the push, s.
EdgeFractions PredictEdgeFractions(const Eigen::Vector2d& xi_Mid,
                                   const Eigen::Vector2d& a_Mid, double omega,
                                   double T, const SupportBox& box) noexcept;

/// Decides whether the robot needs a step.
struct StepTrigger {
  double sagittal = 1.04;  ///< Step above this fraction.
  double lateral = 1.13;
  double sum = 1.95;  ///< Step above this sum of both fractions.

  bool IsNeeded(const EdgeFractions& fractions) const {
    return fractions.sagittal > sagittal || fractions.lateral > lateral ||
           fractions.sagittal + fractions.lateral > sum;
  }
};

/// Returns the thresholds for a robot, between those for a strong and a weak
/// one. A robot whose hips cannot turn its trunk falls in place although its
/// capture point stays inside the soles. Such a robot has the thresholds of
/// `weak`, and one like ours has exactly those of `strong`.
StepTrigger FitToStrength(const StepTrigger& strong, const StepTrigger& weak,
                          const TurnStrength& strength) noexcept;

}  // namespace poise
