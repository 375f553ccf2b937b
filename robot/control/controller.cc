// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/control/controller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "math/so3.h"
#include "robot/control/default_stack.h"
#include "robot/control/fail_safe.h"
#include "robot/control/tasks/scale.h"
#include "robot/control/torque.h"
#include "robot/finding.h"

namespace poise {
namespace {

// A state whose time stamp stands still for longer than this is not believed.
// Rounding: ten periods of 1 ms are 10 ms, and no more.
constexpr double kFrozenAfter = 0.010 + 1e-9;  // s.
constexpr double kNever = -std::numeric_limits<double>::infinity();

// Slack of a limit above this is reported; in its own scale, where 1 is the
// limit.
constexpr double kLimitSlack = 1e-6;

// A motion that misses the dynamics by more than this is none of this robot; of
// what the dynamics are added up from, or as rows of forces are scaled.
constexpr double kDynamicsMet = 1e-9;

// The center of mass goes where it is asked to where that is met to this, m/s2.
constexpr double kFollowing = 0.05;

// A foot that bears less than this part of the weight, and another more than
// that, is let go where a fall sideways asks for more than half of all that can
// be done against it.
constexpr double kUnloaded = 0.03;
constexpr double kLoaded = 0.5;
constexpr double kLettingGo = 0.5;

// It comes back where the feet do again, and the robot is slow and nearly upright.
constexpr double kUprightBase = 0.4;  // rad.
constexpr double kSlow = 0.3;         // m/s.

// What was not expected is a mean over so long, s: long against delays, short
// against the time that a joint takes to its limit. What is more is no push.
constexpr double kMemory = 0.02;
constexpr double kLargestSurprise = 100;  // rad/s2, m/s2.

// Of the fail-safe command.
constexpr double kFailSafeDamping = 10;  // 1/s.

// The norm of a quaternion is 1; rounding, of single precision too, and some steps
// of integration are far below this. What is farther off is no orientation.
constexpr double kQuaternionOff = 1e-3;

bool IsPossible(const Tree& tree, const State& state) {
  if (!IsBelievable(state.q) || !IsBelievable(state.v)) return false;
  return !tree.is_floating() ||
         std::abs(state.q.segment<4>(3).norm() - 1) < kQuaternionOff;
}

const Robot& Checked(const Robot& robot) {
  if (robot.feet.empty()) {
    throw std::invalid_argument("robot " + Quoted(robot.model.name) +
                                ": has no foot, must have one or more");
  }
  if (robot.q_nominal.size() != robot.model.tree.nq()) {
    throw std::invalid_argument(
        "robot " + Quoted(robot.model.name) + ": nominal posture has size " +
        std::to_string(robot.q_nominal.size()) + ", must be " +
        std::to_string(robot.model.tree.nq()));
  }
  return robot;
}

// Those of the feet, then those of the links with a task of their own.
std::vector<int> TickFrames(const Robot& robot,
                            const std::vector<std::string>& links) {
  std::vector<int> frames;
  for (const Foot& foot : robot.feet) frames.push_back(foot.frame);
  for (const std::string& link : links) {
    const auto frame = robot.model.tree.FindFrame(link);
    if (!frame) {
      throw std::invalid_argument("frame " + Quoted(link) + ": robot " +
                                  Quoted(robot.model.name) +
                                  " has no such link");
    }
    frames.push_back(*frame);
  }
  return frames;
}

int NumVariables(const Robot& robot) {
  return robot.model.tree.nv() + 6 * static_cast<int>(robot.feet.size());
}

}  // namespace

Controller::Controller(const Robot& robot, const ControllerOptions& options)
    : robot_(Checked(robot)),
      options_(options),
      weight_(robot_.model.tree.total_mass() *
              robot_.model.tree.gravity_W().norm()),
      force_scale_(ForceScale(robot_.model.tree)),
      stack_(MakeDefaultStack(robot_, options.frames)),
      momentum_(*stack_.Find("momentum")),
      momentum_task_(static_cast<const MomentumTask&>(stack_.task(momentum_))),
      torque_limits_(*stack_.Find("torque_limits")),
      joint_limits_(*stack_.Find("joint_limits")),
      com_(*stack_.Find("com")),
      com_task_(static_cast<const ComTask&>(stack_.task(com_))),
      stance_(robot_.feet, weight_),
      tick_(robot_.model.tree, TickFrames(robot_, options.frames)),
      contacts_(robot_.feet.size()),
      hierarchy_(NumVariables(robot_), stack_.capacity()),
      solver_(NumVariables(robot_), stack_.capacity()),
      solution_(NumVariables(robot_), stack_.capacity()) {
  if (!(options.dt > 0 && options.dt < 1)) {
    throw std::invalid_argument("control period is " +
                                std::to_string(options.dt) +
                                " s, must be above 0 and below 1");
  }
  if (!stack_.SetParameter("friction", "mu", options.friction) ||
      !stack_.SetParameter("yaw", "mu", options.friction)) {
    throw std::invalid_argument("friction is " +
                                std::to_string(options.friction) +
                                ", must be 0 to 10");
  }
  (void)stack_.SetParameter("friction", "inscribed", options.inscribed);
  (void)stack_.SetParameter("momentum", "feedforward", options.feedforward);
  (void)stack_.set_weighted(options.weighted);
  if (options.max_iterations < 1) {
    throw std::invalid_argument("max_iterations is " +
                                std::to_string(options.max_iterations) +
                                ", must be positive");
  }
  solver_.max_iterations = options.max_iterations;
  solver_.max_seconds = options.max_seconds;
  solver_.now = options.now;
  stack_.Resize(&report_);
  normal_force_.setZero(robot_.feet.size());
  reference_.feet.resize(robot_.feet.size());
  reference_.frames.resize(options.frames.size());

  const Tree& tree = robot_.model.tree;
  for (ContactTick& contact : contacts_) contact.J_WC_C.setZero(6, tree.nv());
  unexpected_vdot_.setZero(tree.nv());
  expected_v_.setZero(tree.nv());
  const State nominal{0, robot_.q_nominal, Eigen::VectorXd::Zero(tree.nv())};
  ComputeModel(nominal);
  const Pose X_MidW = MidFeet(contacts_).Inverse();
  X_MidB_ = X_MidW * tick_.X_WB[0];
  p_MidG_ = X_MidW * tick_.p_WG;
  Start(nominal);
}

void Controller::ComputeModel(const State& state) noexcept {
  ComputeTick(robot_.model.tree, state.q, state.v, &tick_);
  for (int i = 0; i < static_cast<int>(contacts_.size()); ++i) {
    const Foot& foot = robot_.feet[i];
    const Pose& X_BF = robot_.model.tree.frames()[foot.frame].X_BF;
    ComputeContact(tick_.frames[i], X_BF.Inverse() * foot.X_BC, &contacts_[i]);
  }
}

void Controller::Start(const State& state) noexcept {
  if (IsPossible(robot_.model.tree, state)) ComputeModel(state);
  for (ContactTick& contact : contacts_) contact.in_contact = true;
  const Pose X_WMid = MidFeet(contacts_);
  reference_.p_WG = X_WMid * p_MidG_;
  reference_.v_WG.setZero();
  reference_.a_WG.setZero();
  reference_.R_WB = X_WMid.R * X_MidB_.R;
  reference_.posture = robot_.q_nominal.tail(robot_.model.tree.num_joints());
  reference_.ground_z = X_WMid.p.z();
  for (size_t i = 0; i < reference_.frames.size(); ++i) {
    reference_.frames[i].X_WF = tick_.frames[contacts_.size() + i].X_WF;
  }
  stance_.Reset();
  normal_force_.setConstant(weight_);
  stack_.EndRamp();
  disturbance_.Forget();
  unexpected_vdot_.setZero();
  expects_ = false;
  last_time_ = kNever;
  frozen_for_ = 0;
  solver_.Forget();
}

void Controller::Update(const State& state, Command* command) noexcept {
  report_.status = TickStatus::kOk;
  report_.fail_safe_reason = FailSafeReason::kNone;
  report_.relaxed.reset();
  UpdateClock(state);
  if (IsFrozen()) {
    FailSafe(FailSafeReason::kClock, state, command);
    return;
  }
  if (!std::isfinite(state.time) || !IsPossible(robot_.model.tree, state)) {
    FailSafe(FailSafeReason::kState, state, command);
    return;
  }
  ComputeModel(state);
  UpdateUnexpectedVdot(state);
  LetFeetGo(state);
  stance_.Update(options_.dt, normal_force_, &contacts_, &reference_);
  stack_.Write({state, tick_, contacts_, reference_, unexpected_vdot_,
                disturbance_.correction_W(), capture_},
               &hierarchy_);
  const Status solved = solver_.Solve(hierarchy_, &solution_);
  stack_.Report(solution_, &report_);

  if (options_.certify) {
    report_.certificate = solution_.certificate;
  }

  const bool is_truncated =
      solved == Status::kIterationLimit && report_.failed_rank > 1;
  report_.dynamics_residual =
      DynamicsResidual(tick_, contacts_, solution_.y, force_scale_);
  const bool is_possible = report_.dynamics_residual <= kDynamicsMet;
  if ((solved != Status::kOptimal && !is_truncated) || !is_possible) {
    FailSafe(FailSafeReason::kNoAnswer, state, command);
    return;
  }
  if (is_truncated) report_.status = TickStatus::kTruncated;
  const int nv = robot_.model.tree.nv();
  for (int i = 0; i < static_cast<int>(contacts_.size()); ++i) {
    normal_force_[i] = solution_.y[nv + 6 * i + 5];
  }
  stack_.Advance(options_.dt, solution_);
  expected_v_ = state.v + options_.dt * solution_.y.head(nv);
  expects_ = frozen_for_ == 0;
  EstimateDisturbance();
  ComputeTorque(tick_, contacts_, solution_.y, &command->tau);
  LimitTorque(command);
  command->status = report_.status;
}

// While its task cannot be met, as in a push, or is eased in, what it lacks is no
// fault of the model. The momentum comes before a place of its own, where both are on.
void Controller::EstimateDisturbance() noexcept {
  const bool by_momentum = stack_.settings(momentum_).enabled;
  const int task = by_momentum ? momentum_ : com_;
  if (!stack_.settings(task).enabled) {
    disturbance_.Forget();
    return;
  }
  if (report_.tasks[task].residual > kFollowing || stack_.is_eased()) return;
  disturbance_.Update(options_.dt,
                      by_momentum ? momentum_task_.gains() : com_task_.gains(),
                      reference_, tick_);
}

// In a fall to the other side, a foot without load holds back the trunk, and its
// leg is worth more as a weight that swings: it is let go. It comes back when all
// is over, or the robot falls to its side.
void Controller::LetFeetGo(const State& state) noexcept {
  MomentumTask::CaptureShares shares;
  if (stack_.settings(momentum_).enabled) {
    shares = momentum_task_.FindCapture(
        {state, tick_, contacts_, reference_, unexpected_vdot_});
  }
  capture_ = shares.all;

  const double turned =
      LogSo3(reference_.R_WB * tick_.X_WB[0].R.transpose()).norm();
  const bool is_over =
      shares.all == 0 && turned < kUprightBase && tick_.v_WG.norm() < kSlow;
  const bool stands = normal_force_.maxCoeff() > kLoaded * weight_;
  const Pose X_MidW = MidFeet(contacts_).Inverse();
  for (int foot = 0; foot < static_cast<int>(contacts_.size()); ++foot) {
    const bool is_left = (X_MidW * contacts_[foot].X_WC.p).y() > 0;
    const double away = is_left ? shares.right : shares.left;
    const double towards = is_left ? shares.left : shares.right;
    const ContactPhase phase = stance_.phase(foot);
    if (phase == ContactPhase::kFree && (is_over || towards > 0)) {
      stance_.PutDown(foot);
    } else if (phase == ContactPhase::kDown && away > kLettingGo && stands &&
               normal_force_[foot] < kUnloaded * weight_) {
      stance_.LetGo(foot);
    }
  }
}

// What the last solution did not say: a push, or a wrong model. A state that has
// not moved on says nothing of it.
void Controller::UpdateUnexpectedVdot(const State& state) noexcept {
  if (!expects_ || frozen_for_ > 0) return;
  const double share = -std::expm1(-options_.dt / kMemory);
  unexpected_vdot_ +=
      share * ((state.v - expected_v_) / options_.dt - unexpected_vdot_);
  unexpected_vdot_ =
      unexpected_vdot_.cwiseMax(-kLargestSurprise).cwiseMin(kLargestSurprise);
}

// Back, or far ahead, is a clock that was set; no clock shows what is no number.
void Controller::UpdateClock(const State& state) noexcept {
  const bool moves = std::isfinite(state.time) && state.time != last_time_;
  frozen_for_ = moves ? 0 : frozen_for_ + options_.dt;
  if (moves) last_time_ = state.time;
}

bool Controller::IsFrozen() const noexcept {
  return frozen_for_ > kFrozenAfter;
}

void Controller::FailSafe(FailSafeReason reason, const State& state,
                          Command* command) noexcept {
  report_.status = TickStatus::kFailSafe;
  report_.fail_safe_reason = reason;
  stack_.EndRamp();
  expects_ = false;
  report_.active.clear();
  report_.lost.clear();
  if (reason != FailSafeReason::kNoAnswer) report_.ClearAnswer();
  const int n = robot_.model.tree.num_joints();
  ComputeFailSafeTorque(tick_, contacts_, state.v.tail(n), kFailSafeDamping,
                        &command->tau);
  LimitTorque(command);
  command->status = report_.status;
}

void Controller::LimitTorque(Command* command) noexcept {
  const double scale =
      stack_.GetParameter("torque_limits", "scale").value_or(1);
  for (Eigen::Index j = 0; j < command->tau.size(); ++j) {
    const double limit = scale * robot_.model.limits[j].effort;
    double& tau = command->tau[j];
    if (!std::isfinite(tau)) tau = 0;  // Whatever went wrong, no motor sees it.
    if (!(limit >= 0)) continue;       // The file gives none.
    // Where there is no motor the row's own scale is 1 N m.
    const double row_scale = limit > 0 ? limit : 1;
    const double slack = (std::abs(tau) - limit) / row_scale;
    Relax({torque_limits_, static_cast<int>(j),
           tau > 0 ? Side::kUpper : Side::kLower,
           stack_.settings(torque_limits_).rank, slack, slack});
    tau = std::clamp(tau, -limit, limit);
  }
  for (const ActiveRow& row : report_.active) {
    if (row.task == joint_limits_) Relax(row);
  }
}

void Controller::Relax(const ActiveRow& row) noexcept {
  const TickStatus status = report_.status;
  const bool may_relax =
      status == TickStatus::kOk || status == TickStatus::kLimitRelaxed;
  if (!may_relax || !(row.slack > kLimitSlack)) return;
  report_.status = TickStatus::kLimitRelaxed;
  if (!report_.relaxed || row.slack > report_.relaxed->slack) {
    report_.relaxed = row;
  }
}

}  // namespace poise
