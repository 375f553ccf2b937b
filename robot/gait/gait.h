// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/robot/gait/com_glide.h"
#include "poise/robot/gait/force_priority.h"
#include "poise/robot/gait/gait_settings.h"
#include "poise/robot/gait/push_estimate.h"
#include "poise/robot/gait/step_answer.h"
#include "poise/robot/gait/step_plan.h"
#include "poise/robot/gait/step_region.h"
#include "poise/robot/gait/step_trigger.h"
#include "poise/robot/gait/swing_path.h"

namespace poise {

/// Phase of a Gait.
enum class GaitPhase {
  kStand,  ///< On both feet. The controller balances in place.
  kShift,  ///< On both feet. The CoM moves over the stance foot of a StepTo().
  kSwing,  ///< One foot is in the air.
};

/// Takes steps. Decides when the feet alone cannot catch the robot, and where
/// and when a foot lands; then steps until the feet are side by side. Takes
/// single steps on command. Between two ticks of the controller, a Gait reads
/// the controller's last tick and writes its reference and its Stance:
///
///     Gait gait(robot, settings);
///     gait.Start();
///     for (const State& state : states) {
///       gait.Update(&controller);
///       controller.Update(state, &command);
///     }
///
/// Until the first step, a Gait does not write the reference of the center of
/// mass, so that others can. After Start() nothing allocates, throws or waits.
class Gait {
 public:
  /// Throws std::invalid_argument if the robot has not two feet.
  Gait(const Robot& robot, const GaitSettings& settings);

  /// Ends all steps and forgets the last push.
  void Start() noexcept;

  /// Plans and writes the next tick. The cost is that of one StepPlan in the
  /// air, and nearly nothing on both feet.
  void Update(Controller* controller) noexcept;

  /// Steps with a foot to a place of the sole's center on the ground, m, with
  /// the heading of the other foot. Does nothing, and says why, unless the
  /// robot stands still on both feet and the leg reaches the place. First the
  /// center of mass moves over the other foot. If a push has moved the robot,
  /// the foot waits, or is given up. A push in the air makes the step one that
  /// catches the robot, at another place.
  [[nodiscard]] StepAnswer StepTo(int foot, const Eigen::Vector2d& p_WC,
                                  const Controller& controller) noexcept;

  /// Takes no further steps until Start(). A foot in the air still lands. A
  /// commanded step whose foot is still on the ground is given up.
  void Stop() noexcept;

  GaitPhase phase() const { return phase_; }
  int swing_foot() const { return swing_; }  ///< Meaningful in kSwing.
  const PlannedStep& plan() const { return plan_; }
  const Eigen::Vector2d& xi_W() const { return xi_W_; }      ///< DCM, m.
  const Eigen::Vector2d& goal_W() const { return goal_W_; }  ///< Landing, m.
  /// Time until the planned landing, s. Meaningful in kSwing.
  double remaining() const { return duration_ - over_; }
  /// How far the predicted capture point was beyond the edge of the support
  /// when the gait decided to step, m; 0 for a step that follows another step
  /// or a command.
  double beyond_edge() const { return beyond_edge_; }
  /// Whether the present step was commanded by StepTo().
  bool is_commanded() const { return is_commanded_; }
  /// Number of steps since the robot last stood at rest.
  int steps() const { return steps_; }
  /// Whether the gait writes the reference of the center of mass.
  bool owns_com() const { return owns_com_; }

 private:
  void MeasureDcm(const Controller& controller) noexcept;
  bool MayStep() const noexcept {
    return !is_stopped_ && steps_ < settings_.max_steps;
  }
  void LookForPush(const Controller& controller) noexcept;
  bool MustStep(const Controller& controller) noexcept;
  bool LeavesSole(const Controller& controller) noexcept;
  int ChooseFoot(const Controller& controller) noexcept;
  StepProblem MakeProblem(const Controller& controller, int swing,
                          double remaining) const noexcept;
  void Begin(int swing, double duration, Controller* controller) noexcept;
  void Stand(Controller* controller) noexcept;
  void Shift(Controller* controller) noexcept;
  void Catch(Controller* controller) noexcept;
  void CatchFromAir(Controller* controller) noexcept;
  void Follow(Controller* controller) noexcept;
  void Land(Controller* controller) noexcept;
  void Rest(Controller* controller) noexcept;
  bool AreFeetSquare(const Controller& controller) const noexcept;
  void TakeCom(const Controller& controller) noexcept;
  Pose StanceFrame(const Controller& controller, int foot) const noexcept;

  Robot robot_;
  GaitSettings settings_;
  std::vector<StepRegion> regions_;
  double mass_, gravity_;
  double nominal_height_;   // Height of G above the soles, m.
  double nominal_width_;    // Between the soles' centers, m.
  Eigen::Vector2d p_MidG_;  // Nominal, m.
  StepPlan planner_;
  PushEstimate push_;
  SwingPath path_;
  ForcePriority priority_;

  GaitPhase phase_ = GaitPhase::kStand;
  bool is_commanded_ = false;
  bool owns_com_ = false;
  int swing_ = 0;
  int steps_ = 0;
  bool is_stopped_ = false;
  double found_ground_for_ = 0;  // Time since a foot was last in the air, s.
  double over_ = 0;              // Time in this phase, s.
  double duration_ = 0;          // Planned time of this phase, s.
  double beyond_edge_ = 0;       // m.
  Eigen::Vector2d lift_off_W_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_W_ = Eigen::Vector2d::Zero();
  PlannedStep plan_;
  double omega_ = 0;
  Eigen::Vector2d xi_W_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d xi_without_k_W_ = Eigen::Vector2d::Zero();
  EdgeFractions fractions_;
  ComGlide com_;
};

}  // namespace poise
