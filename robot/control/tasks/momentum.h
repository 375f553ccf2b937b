// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/com_gains.h"
#include "poise/robot/control/task.h"
#include "poise/robot/control/tasks/trunk.h"
#include "poise/robot/robot.h"

namespace poise {

/// Controls the momentum of the robot about its center of mass G, (20), with
/// feed-forward, over the mass m:
///     (H_G v̇ + bias) / m =
///         [ (-kd_angular k + K e) / m ;
///           kp (p_ref - p_G) + kd (f v_ref - v_G) + f a_ref + c ],
/// where k is the angular momentum, f the parameter feedforward, and c the
/// correction of Disturbance. e is the rotation from the orientation of the
/// trunk T, see FindTrunk(), back to its reference: without it the trunk
/// drifts, because angular momentum is not the derivative of an orientation.
///
/// With TaskInput::capture, the capture blend of BalanceMonitor, the gains of
/// the horizontal position rise and the weights of angular momentum and height
/// fall. The robot then rotates its trunk and arms to stop a fall.
///
/// p_ref is the target of FindComTarget(): over the feet in contact. While
/// Reference::pendulum is on, the rows of the plane are instead those of a
/// linear inverted pendulum with the CoP p_Z, Khadiv et al. 2016:
///     [l̇_x; l̇_y] / m = omega^2 (p_G - p_Z),
/// and f is 1 in the row of the height.
class MomentumTask final : public Task {
 public:
  /// Parameters: kp (30 1/s2), kd (10 1/s), kd_angular (10 1/s), k_orientation
  /// (200 N m/rad; MakeDefaultStack() scales it to the robot); ki and ki_height
  /// (15 and 60 1/s3), see Disturbance; angular_weight (1), of the angular rows
  /// against the linear ones; feedforward (0; with 1, v_ref and a_ref are
  /// used). CaptureSettings: capture (1), capture_from (0.65), capture_full
  /// (1), capture_sideways (1.25). Gains and weights at capture 1: capture_kp
  /// (60 1/s2), capture_kd (30 1/s), capture_angular_weight (0.3),
  /// capture_height_weight (0.3).
  MomentumTask(const Tree& tree, const std::vector<Foot>& feet);

  const ComGains& gains() const { return gains_; }
  const CaptureSettings& capture_settings() const { return capture_; }

  double equality_scale(int) const noexcept override { return mass_; }
  void Write(const TaskInput& input, EqualityBlock* equalities,
             InequalityBlock* inequalities) const noexcept override;

 private:
  // Gains of the horizontal position and weights of rows at capture 1.
  struct CapturedGains {
    double kp = 60;
    double kd = 30;
    double angular_weight = 0.3;
    double height_weight = 0.3;
  };

  double mass_;
  std::vector<Foot> feet_;
  int trunk_;  // A body.
  TrunkReference trunk_reference_;
  ComGains gains_;
  double kd_angular_ = 10;
  double k_orientation_ = 200;
  double angular_weight_ = 1;
  double feedforward_ = 0;
  CaptureSettings capture_;
  CapturedGains captured_;
};

}  // namespace poise
