// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <array>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/robot/gait/step_region.h"

namespace poise {

/// The problem of one step, in the frame S of the stance foot: origin at the
/// center of its sole, x along its heading, z up.
struct StepProblem {
  static constexpr int kSides = StepRegion::kSides;

  Eigen::Vector2d xi_S;  ///< Present DCM, m.
  Eigen::Vector2d p_SZ;  ///< CoP until the landing, m.
  double omega = 0;      ///< Pendulum frequency, 1/s.
  double time_min = 0, time_max = 0, time_nominal = 0;  ///< To landing, s.
  /// Landing region: region_normal_S[i]' u <= region_bound[i], and side * u_y
  /// >= width_min.
  std::array<Eigen::Vector2d, kSides> region_normal_S;
  std::array<double, kSides> region_bound;  ///< m.
  Eigen::Vector2d base_S;                   ///< The base at landing, m.
  Eigen::Vector2d lift_off_S;  ///< Where the foot left the ground, m.
  double time_over = 0;        ///< Since the foot left the ground, s.
  double swing_speed = 1e3;    ///< Bound of the mean speed of the step, m/s.
  double side = 1;             ///< +1: the left foot swings; -1: the right.
  double width_min = 0;
  Eigen::Vector2d u_nominal_S;  ///< Preferred place, m.
  Eigen::Vector2d b_nominal_S;  ///< Preferred DCM offset at landing, m.
  Eigen::Vector2d half_sole;    ///< Half sides of the sole, m.
};

/// Whether the landing region of a problem contains a place.
bool Contains(const StepProblem& problem, const Eigen::Vector2d& u_S) noexcept;

/// The planned step.
struct PlannedStep {
  Eigen::Vector2d u_S = Eigen::Vector2d::Zero();  ///< Landing place, m.
  Eigen::Vector2d b_S = Eigen::Vector2d::Zero();  ///< xi at landing less u, m.
  double time = 0;                                ///< To landing, s.
  double excess = 0;  ///< How far xi is beyond the sole at landing, m.
  double cost = 0;    ///< Cost of the preferences.
  double certificate = 0;
  bool is_optimal = false;
};

/// Plans place and time of a step: Khadiv et al., "Step timing adjustment: a
/// step toward generating robust gaits", 2016, as a strict hierarchy in
/// y = [u; b; exp(w T)]:
///   1. u + b = p + (xi - p) exp(w T), with T and u inside their bounds;
///   2. xi lands over the new sole or between the feet;
///   3. the nominal place, offset and time.
class StepPlan {
 public:
  StepPlan();
  PlannedStep Solve(const StepProblem& problem) noexcept;

  double place_weight = 0.1, offset_weight = 1, time_weight = 0.01;

 private:
  Hierarchy hierarchy_;
  Solver solver_;
  Solution solution_;
};

}  // namespace poise
