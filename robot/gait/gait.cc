// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/gait.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/tasks/support_box.h"
#include "poise/robot/finding.h"
#include "poise/robot/gait/dcm.h"
#include "poise/robot/gait/turn_strength.h"
#include "poise/robot/nominal_tick.h"

namespace poise {
namespace {

// A plan needs this much time.
constexpr double kLeastTime = 0.02;  // s.

// CopForDcm() with less time would ask for a CoP far outside of the sole, and
// change it fast.
constexpr double kLeastCopTime = 0.05;  // s.

// StepTo() needs a robot slower than this.
constexpr double kSlow = 0.05;  // m/s.

// An impact lasts at most this long.
constexpr double kImpactTime = 0.05;  // s.

// The foot of a StepTo() rises after this multiple of the shift time, or later
// if a push has moved the robot. After the last multiple it is given up.
constexpr double kShiftTimes = 1.3;
constexpr double kMostShiftTimes = 4;

// The foot rises if xi is inside this part of the other foot's sole.
constexpr double kCentered = 0.6;

const Robot& Checked(const Robot& robot) {
  if (robot.feet.size() == 2) return robot;
  throw std::invalid_argument("robot " + Quoted(robot.model.name) + ": has " +
                              std::to_string(robot.feet.size()) +
                              " feet, must have two to take steps");
}

Eigen::Vector2d InFrame(const Pose& X, const Eigen::Vector2d& p) {
  return (X * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
}

}  // namespace

Gait::Gait(const Robot& robot, const GaitSettings& settings)
    : robot_(Checked(robot)),
      settings_(settings),
      mass_(robot.model.tree.total_mass()),
      gravity_(robot.model.tree.gravity_W().norm()),
      push_(mass_, settings.push) {
  const Tick tick = NominalTick(robot_);
  nominal_height_ = tick.p_WG.z();
  settings_ = Scaled(settings, nominal_height_);
  settings_.trigger = FitToStrength(settings.trigger, settings.weak_trigger,
                                    ComputeTurnStrength(robot_));
  p_MidG_ = tick.p_WG.head<2>();
  const auto center = [&](const Foot& foot) {
    return (tick.X_WB[foot.body] * foot.X_BC).p;
  };
  nominal_width_ = (center(robot_.feet[0]) - center(robot_.feet[1])).norm();
  for (int foot = 0; foot < 2; ++foot) {
    regions_.emplace_back(robot_, foot, settings_.region);
  }
  planner_.place_weight = settings_.place_weight;
  planner_.time_weight = settings_.time_weight;
  Start();
}

void Gait::Start() noexcept {
  phase_ = GaitPhase::kStand;
  is_commanded_ = owns_com_ = false;
  is_stopped_ = false;
  steps_ = 0;
  found_ground_for_ = kImpactTime;
  push_.Reset();
}

void Gait::Stop() noexcept {
  is_stopped_ = true;
  if (phase_ != GaitPhase::kShift) return;
  phase_ = GaitPhase::kStand;
  over_ = 0;
}

// The frame S of a stance foot: level, along its heading, on the ground.
Pose Gait::StanceFrame(const Controller& controller, int foot) const noexcept {
  const Pose& X_WC = controller.contacts()[foot].X_WC;
  const double yaw = std::atan2(X_WC.R(1, 0), X_WC.R(0, 0));
  Pose X_WS;
  X_WS.R = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_WS.p << X_WC.p.head<2>(), controller.reference().ground_z;
  return X_WS;
}

void Gait::MeasureDcm(const Controller& controller) noexcept {
  const Tick& tick = controller.tick();
  const double height = tick.p_WG.z() - controller.reference().ground_z;
  omega_ = PendulumFrequency(gravity_, height);
  xi_without_k_W_ = ComputeDcm(tick, mass_, height, omega_, 0);
  xi_W_ = ComputeDcm(tick, mass_, height, omega_, settings_.share_of_k);
}

// The impact of a foot that has found the ground again is no push.
void Gait::LookForPush(const Controller& controller) noexcept {
  for (int foot = 0; foot < 2; ++foot) {
    if (controller.stance().phase(foot) != ContactPhase::kLost) continue;
    found_ground_for_ = 0;
  }
  found_ground_for_ += settings_.dt;
  if (found_ground_for_ < kImpactTime) {
    push_.Reset();
  } else {
    push_.Update(settings_.dt, controller.tick(), controller.unmodelled_vdot());
  }
}

void Gait::Update(Controller* controller) noexcept {
  MeasureDcm(*controller);
  LookForPush(*controller);
  priority_.Set(steps_ > 0, &controller->stack());
  switch (phase_) {
    case GaitPhase::kStand:
    case GaitPhase::kShift:
      // A foot that is released during a push could not carry the robot.
      controller->reference().may_release = !push_.acts();
      if (MustStep(*controller) && MayStep()) {
        is_commanded_ = false;
        Begin(ChooseFoot(*controller), settings_.time_min, controller);
        beyond_edge_ = fractions_.beyond;
        Catch(controller);
      } else if (phase_ == GaitPhase::kShift) {
        Shift(controller);
      } else {
        Stand(controller);
      }
      return;
    case GaitPhase::kSwing:
      if (controller->stance().phase(swing_) == ContactPhase::kDown) {
        Land(controller);
      } else if (controller->stance().phase(swing_) !=
                 ContactPhase::kStepping) {
        Rest(controller);  // The foot was taken over by somebody else.
      } else if (!is_commanded_) {
        Catch(controller);
      } else if (LeavesSole(*controller) && MayStep()) {
        CatchFromAir(controller);
      } else {
        Follow(controller);
      }
      return;
  }
}

bool Gait::MustStep(const Controller& controller) noexcept {
  for (int foot = 0; foot < 2; ++foot) {
    const ContactPhase phase = controller.stance().phase(foot);
    if (phase != ContactPhase::kDown && phase != ContactPhase::kFree &&
        phase != ContactPhase::kReturning) {
      return false;
    }
  }
  if (controller.report().status == TickStatus::kFailSafe) return false;
  const std::vector<ContactTick>& contacts = controller.contacts();
  const Pose X_MidW = MidFeet(contacts).Inverse();
  const auto reach = [&](SupportSide side) {
    return SupportReach(robot_.feet, contacts, X_MidW, side);
  };
  const SupportBox box{reach(kFront), reach(kBack), reach(kLeft),
                       reach(kRight)};
  const Eigen::Vector2d a_Mid = X_MidW.R.topLeftCorner<2, 2>() * push_.a_WG();
  fractions_ = PredictEdgeFractions(InFrame(X_MidW, xi_without_k_W_), a_Mid,
                                    omega_, push_.remaining(), box);
  return settings_.trigger.IsNeeded(fractions_);
}

// Returns whether xi has left the sole of the only foot on the ground.
bool Gait::LeavesSole(const Controller& controller) noexcept {
  const Pose X_CW = StanceFrame(controller, 1 - swing_).Inverse();
  const Eigen::Vector2d half = robot_.feet[1 - swing_].half_size;
  fractions_ = PredictEdgeFractions(InFrame(X_CW, xi_without_k_W_),
                                    Eigen::Vector2d::Zero(), omega_, 0,
                                    {half.x(), half.x(), half.y(), half.y()});
  return settings_.trigger.IsNeeded(fractions_);
}

// Returns the foot whose step leaves xi nearer to the new support.
int Gait::ChooseFoot(const Controller& controller) noexcept {
  constexpr double kEqual = 1e-3;  // Excesses that differ less are equal, m.
  PlannedStep best;
  int choice = -1;
  for (int swing = 0; swing < 2; ++swing) {
    StepProblem problem = MakeProblem(controller, swing, settings_.time_min);
    // Where xi will be at the end of the push.
    const Pose X_SW = StanceFrame(controller, 1 - swing).Inverse();
    problem.xi_S += X_SW.R.topLeftCorner<2, 2>() * push_.a_WG() *
                    push_.remaining() / omega_;
    const PlannedStep step = planner_.Solve(problem);
    if (choice < 0 || step.excess < best.excess - kEqual ||
        (step.excess < best.excess + kEqual && step.cost < best.cost)) {
      choice = swing;
      best = step;
    }
  }
  return choice;
}

StepProblem Gait::MakeProblem(const Controller& controller, int swing,
                              double remaining) const noexcept {
  const Tick& tick = controller.tick();
  const Pose X_SW = StanceFrame(controller, 1 - swing).Inverse();
  const bool is_in_air = phase_ == GaitPhase::kSwing && swing_ == swing;
  const double over = is_in_air ? over_ : 0;
  const Eigen::Vector2d half = robot_.feet[1 - swing].half_size;
  StepProblem problem;
  problem.omega = omega_;
  problem.xi_S = InFrame(X_SW, xi_W_);
  problem.half_sole = settings_.sole_fraction * half;
  problem.p_SZ =
      problem.xi_S.cwiseMax(-problem.half_sole).cwiseMin(problem.half_sole);
  problem.time_over = over;
  problem.time_min = std::max(kLeastTime, settings_.time_min - over);
  problem.time_max = std::max(problem.time_min, settings_.time_max - over);
  problem.time_nominal =
      std::clamp(remaining, problem.time_min, problem.time_max);
  problem.swing_speed = settings_.swing_speed;
  problem.lift_off_S = InFrame(
      X_SW, is_in_air ? lift_off_W_
                      : controller.contacts()[swing].X_WC.p.head<2>().eval());
  problem.side = swing == 0 ? 1 : -1;
  problem.width_min =
      std::min(nominal_width_, 2 * half.y() + settings_.sole_gap);
  problem.u_nominal_S << 0, problem.side * nominal_width_;
  problem.b_nominal_S = settings_.xi_beyond * problem.u_nominal_S;

  // The region moves with the base, which keeps its place beside G.
  const StepRegion& region = regions_[swing];
  const Eigen::Vector2d c_T = PredictCom(InFrame(X_SW, tick.p_WG.head<2>()),
                                         (X_SW.R * tick.v_WG).head<2>(),
                                         problem.p_SZ, omega_, remaining);
  problem.base_S = c_T + (X_SW.R * (tick.X_WB[0].p - tick.p_WG)).head<2>();
  for (int i = 0; i < StepRegion::kSides; ++i) {
    problem.region_normal_S[i] = StepRegion::normal(i);
    problem.region_bound[i] = StepRegion::normal(i).dot(problem.base_S) +
                              region.support(i, region.max_sink());
  }
  return problem;
}

void Gait::Begin(int swing, double duration, Controller* controller) noexcept {
  const ContactTick& contact = controller->contacts()[swing];
  const double ground_z = controller->reference().ground_z;
  if (!owns_com_) TakeCom(*controller);
  swing_ = swing;
  phase_ = GaitPhase::kSwing;
  over_ = 0;
  duration_ = duration;
  beyond_edge_ = 0;
  ++steps_;
  lift_off_W_ = contact.X_WC.p.head<2>();
  path_.Configure(is_commanded_ ? settings_.command_path : settings_.path);
  path_.Start(lift_off_W_, contact.X_WC.p.z() - ground_z);
  Stance& stance = controller->stance();
  if (stance.phase(1 - swing) != ContactPhase::kDown) stance.PutDown(1 - swing);
  stance.Step(swing);
}

// Takes over the reference of the center of mass where it is.
void Gait::TakeCom(const Controller& controller) noexcept {
  com_.StartAt(controller.reference());
  owns_com_ = true;
}

// One tick of a step that catches the robot: plans it, and writes the CoP, the
// height and the foot.
void Gait::Catch(Controller* controller) noexcept {
  Reference& reference = controller->reference();
  double remaining = std::max(kLeastTime, duration_ - over_);
  const StepProblem problem = MakeProblem(*controller, swing_, remaining);
  plan_ = planner_.Solve(problem);
  const Pose X_WS = StanceFrame(*controller, 1 - swing_);
  if (remaining > settings_.freeze && plan_.is_optimal) {
    duration_ = over_ + plan_.time;
    remaining = std::max(kLeastTime, plan_.time);
    goal_W_ = InFrame(X_WS, plan_.u_S);
  }
  const Eigen::Vector2d u_S = InFrame(X_WS.Inverse(), goal_W_);

  // The CoP that brings xi to its place at the landing.
  const Eigen::Vector2d p_S =
      CopForDcm(problem.xi_S, u_S + problem.b_nominal_S, omega_,
                std::max(kLeastCopTime, remaining))
          .cwiseMax(-problem.half_sole)
          .cwiseMin(problem.half_sole);
  PendulumReference& pendulum = reference.pendulum;
  pendulum.is_on = true;
  pendulum.omega = omega_;
  pendulum.p_WZ = InFrame(X_WS, p_S);
  pendulum.angular_weight = settings_.angular_weight;
  pendulum.height_weight = settings_.height_weight;
  // To brake the fall before the landing would push xi away.
  pendulum.max_rise = steps_ < 2 ? settings_.first_rise : settings_.later_rise;

  const StepRegion& region = regions_[swing_];
  const double sink = std::min(
      region.max_sink(),
      std::max(settings_.min_sink, region.SinkFor(u_S - problem.base_S)));
  com_.MoveHeightTo(settings_.dt, nominal_height_ - sink,
                    remaining - (1 - settings_.sink_at) * duration_,
                    &reference);

  path_.Advance(settings_.dt, goal_W_, over_, duration_);
  path_.Write(X_WS.R, reference.ground_z, &reference.feet[swing_]);
  over_ += settings_.dt;
}

bool Gait::AreFeetSquare(const Controller& controller) const noexcept {
  const Pose X_SW = StanceFrame(controller, 1).Inverse();
  const Eigen::Vector2d left_S =
      InFrame(X_SW, controller.contacts()[0].X_WC.p.head<2>());
  return std::abs(left_S.x()) < settings_.square &&
         std::abs(left_S.y() - nominal_width_) < settings_.square;
}

// The foot has landed. A step that catches the robot is followed by a step of
// the other foot, until the feet are square.
void Gait::Land(Controller* controller) noexcept {
  if (!is_commanded_ && !AreFeetSquare(*controller) && MayStep()) {
    Begin(1 - swing_, settings_.time_min, controller);
    Catch(controller);
    return;
  }
  Rest(controller);
}

// Stops stepping: the center of mass glides to its place from where it is.
void Gait::Rest(Controller* controller) noexcept {
  Reference& reference = controller->reference();
  if (reference.pendulum.is_on) {
    const Tick& tick = controller->tick();
    com_.RestartPlane(tick.p_WG.head<2>(), tick.v_WG.head<2>());
    reference.pendulum.is_on = false;
  }
  phase_ = GaitPhase::kStand;
  is_commanded_ = false;
  over_ = 0;
  Stand(controller);
}

// On both feet, after a step: the center of mass goes back above the middle.
void Gait::Stand(Controller* controller) noexcept {
  if (!owns_com_) return;
  com_.MoveTo(settings_.dt, InFrame(MidFeet(controller->contacts()), p_MidG_),
              nominal_height_, settings_.rest_time - over_,
              &controller->reference());
  over_ += settings_.dt;
  const bool is_still =
      over_ > settings_.rest_time && controller->tick().v_WG.norm() < kSlow;
  if (is_still) steps_ = 0;
}

StepAnswer Gait::StepTo(int foot, const Eigen::Vector2d& p_WC,
                        const Controller& controller) noexcept {
  MeasureDcm(controller);
  if (foot != 0 && foot != 1) return StepAnswer::kUnknownFoot;
  if (!p_WC.allFinite()) return StepAnswer::kNotANumber;
  if (is_stopped_) return StepAnswer::kStopped;
  if (phase_ != GaitPhase::kStand) return StepAnswer::kSteps;
  for (int each = 0; each < 2; ++each) {
    if (controller.stance().phase(each) != ContactPhase::kDown) {
      return StepAnswer::kNotOnBothFeet;
    }
  }
  if (controller.report().status == TickStatus::kFailSafe) {
    return StepAnswer::kFailSafe;
  }
  if (push_.acts()) return StepAnswer::kPushed;
  if (controller.tick().v_WG.norm() > kSlow) return StepAnswer::kMoves;
  const StepProblem problem = MakeProblem(controller, foot, kLeastTime);
  const Eigen::Vector2d u_S =
      InFrame(StanceFrame(controller, 1 - foot).Inverse(), p_WC);
  if (!Contains(problem, u_S)) return StepAnswer::kOutOfReach;
  if (!owns_com_) TakeCom(controller);
  swing_ = foot;
  goal_W_ = p_WC;
  phase_ = GaitPhase::kShift;
  over_ = 0;
  return StepAnswer::kAccepted;
}

// Moves the center of mass over the sole of the stance foot, then lifts the
// other foot.
void Gait::Shift(Controller* controller) noexcept {
  const Pose X_WS = StanceFrame(*controller, 1 - swing_);
  com_.MoveTo(settings_.dt, InFrame(X_WS, p_MidG_),
              nominal_height_ - settings_.min_sink,
              settings_.shift_time - over_, &controller->reference());
  over_ += settings_.dt;
  if (over_ < kShiftTimes * settings_.shift_time) return;
  const Eigen::Vector2d half = robot_.feet[1 - swing_].half_size;
  const Eigen::Array2d xi_S = InFrame(X_WS.Inverse(), xi_W_);
  if (push_.acts() || (xi_S.abs() > kCentered * half.array()).any()) {
    if (over_ > kMostShiftTimes * settings_.shift_time) Rest(controller);
    return;
  }
  const Eigen::Vector2d goal_W = goal_W_;
  is_commanded_ = true;
  Begin(swing_, settings_.command_time, controller);
  goal_W_ = goal_W;
  Follow(controller);
}

// Makes a step on command a step that catches the robot, from where the foot
// is.
void Gait::CatchFromAir(Controller* controller) noexcept {
  is_commanded_ = false;
  over_ = 0;
  duration_ = settings_.time_min;
  beyond_edge_ = fractions_.beyond;
  lift_off_W_ = controller->contacts()[swing_].X_WC.p.head<2>();
  path_.Configure(settings_.path);
  Catch(controller);
}

// One tick of a step on command, with the center of mass at rest.
void Gait::Follow(Controller* controller) noexcept {
  Reference& reference = controller->reference();
  path_.Advance(settings_.dt, goal_W_, over_, duration_);
  path_.Write(StanceFrame(*controller, 1 - swing_).R, reference.ground_z,
              &reference.feet[swing_]);
  over_ += settings_.dt;
}

}  // namespace poise
