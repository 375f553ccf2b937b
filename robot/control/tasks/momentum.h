// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "dynamics/tree.h"
#include "robot/control/com_gains.h"
#include "robot/control/task.h"
#include "robot/robot.h"

namespace poise {

/// Steers the momentum of the robot about its center of mass G, (20), with
/// feed-forward, over the mass m:
///     (H_G v̇ + bias) / m = [ (-kd_angular k + K e) / m ;
///                            kp (p_ref - p_G) + kd (v_ref - v_G) + a_ref ],
/// where k is the angular momentum, and e the rotation from the base's
/// orientation back to its reference: without it the pelvis drifts, as angular
/// momentum is no derivative of an orientation.
///
/// Where the feet alone cannot bring the robot to rest, angular momentum must,
/// and the sooner the better, as a fall grows with exp(w t). That is where the
/// capture point of the robot with its angular momentum given back,
///     xi = p_G + (v_G + k x z / (m h)) / w,    w = sqrt(g / h),
/// h the height of G above the soles, is near their edge: the gains of the place
/// rise and the rows of angular momentum and height weigh less, with
/// TaskInput::capture.
///
/// While a foot is in the air, the place to be is over the others: p_ref is
/// brought into the middle half of their soles.
class MomentumTask final : public Task {
 public:
  /// Parameters: kp (30 1/s2), kd (10 1/s), kd_angular (10 1/s), k_orientation
  /// (200 N m/rad); ki and ki_height (15 and 60 1/s3), see Disturbance;
  /// angular_weight (1), of the angular rows against the linear ones;
  /// feedforward (0; with 1, v_ref and a_ref are used); capture (1; with 0, no
  /// push is too large) with capture_from (0.65), capture_full (1) and
  /// capture_sideways (1.25), see FindCapture(), and what holds there:
  /// capture_kp (60 1/s2), capture_kd (30 1/s), capture_angular_weight (0.3),
  /// capture_height_weight (0.3).
  MomentumTask(const Tree& tree, const std::vector<Foot>& feet);

  /// How far the capture point xi is on its way from its reference to the edge of
  /// the soles, as 0 at capture_from of it to 1 at capture_full. Sideways that is
  /// capture_sideways times farther, as there a foot can be let go.
  struct CaptureShares {
    double all = 0;  ///< The largest, of the front and the back as well.
    double left = 0;
    double right = 0;
  };
  CaptureShares FindCapture(const TaskInput& input) const noexcept;

  const ComGains& gains() const { return gains_; }

  double equality_scale(int) const noexcept override { return mass_; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  Eigen::Vector3d ComReference(const TaskInput& input) const noexcept;

  double mass_;
  double gravity_;
  std::vector<Foot> feet_;
  ComGains gains_;
  double kd_angular_ = 10;
  double k_orientation_ = 200;
  double angular_weight_ = 1;
  double feedforward_ = 0;
  double capture_ = 1;
  double capture_from_ = 0.65;
  double capture_full_ = 1;
  double capture_sideways_ = 1.25;
  double capture_kp_ = 60;
  double capture_kd_ = 30;
  double capture_angular_weight_ = 0.3;
  double capture_height_weight_ = 0.3;
};

}  // namespace poise
