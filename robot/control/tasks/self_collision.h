// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/collision/collision_model.h"
#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Keeps the bodies of the robot apart, by a lower bound on the acceleration of
/// the distance d between two bodies:
///     d̈ ≈ c v̇ + b >= l = -2 w ḋ - w² (d - d_min).
/// On the bound the distance comes to rest at d_min, critically damped, as a
/// joint does at its limit, see JointLimitsTask. c is the derivative of d by
/// the joints between the two bodies; b has the accelerations of the closest
/// points at v̇ = 0, relative to the last common body, and the unmodelled v̇.
/// The rotation of the gradient of d is neglected. Between two points at the
/// distance r, it would add |v_tan|² / r to d̈, where v_tan is the relative
/// velocity across the line between them. This term pushes the points apart.
///
/// Bodies that are too near are moved apart at 3 % of sqrt(g reach) at most,
/// instead of w (d_min - d) / 2.
///
/// There is a row for each pair of CollisionModel; d is the distance between
/// their nearest capsules, with softness 0.01, so that c is continuous. A row
/// that is far from binding is loosened to -infinity: with u = -l > 0,
///     l' = -u / (1 - u / u_max) for u < u_max, no row for u >= u_max,
/// u_max the acceleration of gravity. Near the bound (u -> 0) nothing is
/// loosened, so that d keeps d_min.
///
/// Bodies that stand close together in the nominal posture, at d_0, keep
/// min(d_min, d_0 / 2, d_0 - d_min / 2) instead of d_min, so that the posture
/// is well inside the bound. A pair that overlaps there by more than half of
/// its smaller radius has no row: its capsules do not describe the bodies well
/// enough. The two feet have no row either, because the capsule of a flat foot
/// reaches beyond its sides; StepRegion keeps the soles apart. Rows are divided
/// by w² and a quarter of the reach.
///
/// Balance comes before a touch of an arm: rows of pairs other than leg and leg
/// are loosened by the capture blend c, u by u_max c / (1 - c), and left out
/// while a released foot swings for balance. While Reference::pendulum is on,
/// as in steps that catch the robot, there are no rows.
class SelfCollisionTask final : public Task {
 public:
  /// Parameters: d_min (1 % of the reach, 12 mm for the humanoid); omega
  /// (34.5 sqrt(g / reach), 100 1/s).
  explicit SelfCollisionTask(const Robot& robot);
  bool HasRows(const TaskInput& input) const noexcept override;
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

  const CollisionModel& model() const { return model_; }

 private:
  // Velocity and acceleration of a point of a body relative to an ancestor.
  struct PointMotion {
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    Eigen::Vector3d a = Eigen::Vector3d::Zero();
  };
  // Numbers of a tick that hold for all pairs.
  struct Common {
    // Upper bound of the speed of a point of a capsule relative to another,
    // m/s.
    double max_speed;
    double looseness_of_arms;  // 0 (strict) to 1 (no rows).
    // A pair has no row if balls around its bodies are this far apart, m.
    double far;
  };
  // The bound of a pair in a tick.
  struct Bound {
    bool is_near = false;
    double lower = 0;  // Bound of c v̇, m/s2.
    ClosestPoints closest;
  };

  SelfCollisionTask(const Robot& robot, CollisionModel model);
  PointMotion Relative(const TaskInput& input, int body, int ancestor,
                       const Eigen::Vector3d& p_WQ,
                       const Eigen::Vector3d& gradient,
                       double* unmodelled) const noexcept;
  Common FindCommon(const TaskInput& input) const noexcept;
  bool IsFar(const TaskInput& input, const CollisionPair& pair,
             const Common& common) const noexcept;
  Bound FindBound(const TaskInput& input, int pair,
                  const Common& common) const noexcept;
  void WriteChain(const Tick& tick, int body, int ancestor,
                  const Eigen::Vector3d& p_WQ, const Eigen::Vector3d& gradient,
                  Eigen::Ref<Eigen::RowVectorXd> row) const noexcept;

  CollisionModel model_;
  std::vector<Joint> joints_;
  int q_start_;
  int v_start_;
  // By joint: largest distance from its axis to a capsule that it moves while
  // all sliders are at 0, m.
  std::vector<double> lever_;
  std::vector<int> leg_;  // By body: index of the foot, or -1.
  // By pair: the distance in the nominal posture, m.
  std::vector<double> nominal_;
  double loosest_;  // u_max, m/s2.
  double d_min_;
  double omega_;
  double apart_;  // Largest desired speed of bodies that are too near, m/s.
};

}  // namespace poise
