// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/control/controller.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "poise/robot/control/default_stack.h"
#include "poise/robot/control/fail_safe.h"
#include "poise/robot/control/tasks/scale.h"
#include "poise/robot/control/torque.h"
#include "poise/robot/finding.h"

namespace poise {
namespace {

// A limit is reported as relaxed if its slack is above this. The slack is in
// the scale of the row; for a torque, this is a fraction of the limit.
constexpr double kLimitSlack = 1e-6;

// A solution whose DynamicsResidual() is above this does not meet the dynamics.
constexpr double kDynamicsMet = 1e-9;

// The center of mass follows its task if the residual is below this, m/s2.
constexpr double kFollowing = 0.05;

// Joint damping of the fail-safe command, for robot/models/humanoid.urdf.
constexpr double kFailSafeDamping = 10;  // 1/s.

void CheckTimes(const ControllerOptions& options) {
  if (!(options.dt > 0 && options.dt < 1)) {
    throw std::invalid_argument("control period is " +
                                std::to_string(options.dt) +
                                " s, must be above 0 and below 1");
  }
  for (const auto& [name, limit] :
       {std::pair("max_modelled_seconds", options.max_modelled_seconds),
        std::pair("max_seconds", options.max_seconds)}) {
    if (limit >= 0) continue;
    throw std::invalid_argument(std::string(name) + " is " +
                                PrintNumber(limit) + " s, must be 0 or more");
  }
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

// Returns the frames of the feet, then those of the links with a task
// frame.LINK.
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

Stack MakeStack(const Robot& robot, const ControllerOptions& options) {
  Stack stack = MakeDefaultStack(robot, options.frames);
  if (options.add_tasks) options.add_tasks(&stack);
  return stack;
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
      scale_(MakeFroudeScale(robot_)),
      stack_(MakeStack(robot_, options)),
      momentum_(*stack_.Find("momentum")),
      momentum_task_(static_cast<const MomentumTask&>(stack_.task(momentum_))),
      torque_limits_(*stack_.Find("torque_limits")),
      joint_limits_(*stack_.Find("joint_limits")),
      com_(*stack_.Find("com")),
      com_task_(static_cast<const ComTask&>(stack_.task(com_))),
      guard_(robot_.model.tree),
      stance_(robot_.feet, weight_, scale_),
      monitor_(robot_.model.tree, robot_.feet, scale_),
      drag_(robot_),
      tick_(robot_.model.tree, TickFrames(robot_, options.frames)),
      contacts_(robot_.feet.size()),
      hierarchy_(NumVariables(robot_), stack_.capacity(),
                 stack_.total_capacity()),
      solver_(NumVariables(robot_), stack_.capacity(),
              stack_.max_leading_rows()),
      solution_(NumVariables(robot_), stack_.capacity()),
      disturbance_(scale_),
      unmodelled_(robot_.model.tree.nv(), scale_) {
  CheckTimes(options);
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
  solver_.finds_nullity = false;
  solver_.max_modelled_seconds = options.max_modelled_seconds;
  solver_.max_seconds = options.max_seconds;
  solver_.now = options.now;
  stack_.Resize(&report_);
  normal_force_.setZero(robot_.feet.size());
  reference_.feet.resize(robot_.feet.size());
  reference_.frames.resize(options.frames.size());

  const Tree& tree = robot_.model.tree;
  for (ContactTick& contact : contacts_) contact.J_WC_C.setZero(6, tree.nv());
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
  if (guard_.IsValid(state)) ComputeModel(state);
  for (ContactTick& contact : contacts_) contact.in_contact = true;
  const Pose X_WMid = MidFeet(contacts_);
  reference_.p_WG = X_WMid * p_MidG_;
  reference_.v_WG.setZero();
  reference_.a_WG.setZero();
  reference_.pendulum = {};
  reference_.may_release = true;
  reference_.R_WB = X_WMid.R * X_MidB_.R;
  reference_.posture = robot_.q_nominal.tail(robot_.model.tree.num_joints());
  reference_.ground_z = X_WMid.p.z();
  for (size_t i = 0; i < contacts_.size(); ++i) {
    reference_.feet[i] = {contacts_[i].X_WC};
  }
  for (size_t i = 0; i < reference_.frames.size(); ++i) {
    reference_.frames[i] = {tick_.frames[contacts_.size() + i].X_WF};
  }
  stance_.Reset();
  normal_force_.setConstant(weight_);
  stack_.EndRamp();
  disturbance_.Forget();
  unmodelled_.Reset();
  drag_.Reset();
  guard_.Reset();
  solver_.Forget();
}

void Controller::Update(const State& state, Command* command) noexcept {
  const FailSafeReason objection = AcceptState(state);
  if (objection != FailSafeReason::kNone) {
    FailSafe(objection, state, command);
    return;
  }
  ComputeModel(state);
  UpdateStance(state);
  WriteTasks(state);
  if (!Solve()) {
    FailSafe(FailSafeReason::kNoAnswer, state, command);
    return;
  }
  ComputeCommand(state, command);
}

FailSafeReason Controller::AcceptState(const State& state) noexcept {
  report_.status = TickStatus::kOk;
  report_.fail_safe_reason = FailSafeReason::kNone;
  report_.relaxed.reset();
  return guard_.Check(options_.dt, state);
}

void Controller::UpdateStance(const State& state) noexcept {
  if (guard_.clock_moves()) unmodelled_.Update(options_.dt, state.v);
  JudgeBalance();
  stance_.Update(options_.dt, normal_force_, &contacts_, &reference_);
}

// The balance monitor decides which feet stance releases and brings back.
void Controller::JudgeBalance() noexcept {
  CaptureSettings settings = momentum_task_.capture_settings();
  if (!stack_.settings(momentum_).enabled || reference_.pendulum.is_on) {
    settings.capture = 0;
  }
  monitor_.Update(tick_, contacts_, reference_, settings, normal_force_);
  const Balance& balance = monitor_.balance();
  for (int foot = 0; foot < static_cast<int>(contacts_.size()); ++foot) {
    const ContactPhase phase = stance_.phase(foot);
    if (phase == ContactPhase::kFree && balance.feet[foot].comes_back) {
      stance_.PutDown(foot);
    } else if (phase == ContactPhase::kDown && balance.feet[foot].is_released) {
      stance_.LetGo(foot);
    }
  }
}

void Controller::WriteTasks(const State& state) noexcept {
  stack_.Write({state, tick_, contacts_, reference_, unmodelled_.vdot(),
                disturbance_.correction_W(),
                reference_.pendulum.is_on ? 1.0 : monitor_.balance().capture},
               &hierarchy_);
}

// Returns false if the tick has no solution that meets the dynamics.
bool Controller::Solve() noexcept {
  const Status solved = solver_.Solve(hierarchy_, &solution_);
  stack_.Report(solution_, &report_);
  report_.modelled_seconds = solver_.modelled_seconds();
  report_.certificate = solution_.certificate;
  report_.dynamics_residual =
      DynamicsResidual(tick_, contacts_, solution_.y, force_scale_);
  const bool is_possible = report_.dynamics_residual <= kDynamicsMet;
  const bool is_truncated =
      solved == Status::kIterationLimit && report_.failed_level > 1;
  if ((solved != Status::kOptimal && !is_truncated) || !is_possible) {
    return false;
  }
  if (is_truncated) report_.status = TickStatus::kTruncated;
  return true;
}

void Controller::ComputeCommand(const State& state, Command* command) noexcept {
  Remember(state);
  ComputeTorque(tick_, contacts_, solution_.y, &command->tau);
  const int nv = robot_.model.tree.nv();
  const int n = robot_.model.tree.num_joints();
  if (options_.drag_compensation) {
    drag_.AddTo(options_.dt, TorqueScale(), state.v.tail(n),
                solution_.y.segment(nv - n, n), &command->tau);
  }
  LimitTorque(command);
  command->status = report_.status;
}

// Stores the data of this solution that the next tick needs.
void Controller::Remember(const State& state) noexcept {
  const int nv = robot_.model.tree.nv();
  for (int i = 0; i < static_cast<int>(contacts_.size()); ++i) {
    normal_force_[i] = solution_.y[nv + 6 * i + 5];
  }
  stack_.Advance(options_.dt, solution_);
  // A state whose clock stands still may be old: no prediction starts from it.
  if (guard_.clock_moves()) {
    unmodelled_.Predict(options_.dt, state.v, solution_.y.head(nv));
  } else {
    unmodelled_.ForgetPrediction();
  }
  EstimateDisturbance();
}

// The residual of the task is not a model error while the task is infeasible
// (as in a push) or eased in. If both momentum and com are on, momentum counts.
void Controller::EstimateDisturbance() noexcept {
  const bool by_momentum = stack_.settings(momentum_).enabled;
  const int task = by_momentum ? momentum_ : com_;
  if (reference_.pendulum.is_on) return;
  if (!stack_.settings(task).enabled) {
    disturbance_.Forget();
    return;
  }
  if (report_.tasks[task].residual > kFollowing || stack_.is_eased()) return;
  disturbance_.Update(options_.dt,
                      by_momentum ? momentum_task_.gains() : com_task_.gains(),
                      reference_, tick_);
}

void Controller::FailSafe(FailSafeReason reason, const State& state,
                          Command* command) noexcept {
  report_.status = TickStatus::kFailSafe;
  report_.fail_safe_reason = reason;
  stack_.EndRamp();
  unmodelled_.ForgetPrediction();
  report_.active.clear();
  report_.lost.clear();
  if (reason != FailSafeReason::kNoAnswer) report_.ClearAnswer();
  const int n = robot_.model.tree.num_joints();
  ComputeFailSafeTorque(tick_, contacts_, state.v.tail(n),
                        kFailSafeDamping / scale_.time(), &command->tau);
  LimitTorque(command);
  command->status = report_.status;
}

// Returns the factor on the motors' limits.
double Controller::TorqueScale() const noexcept {
  return stack_.GetParameter("torque_limits", "scale").value_or(1);
}

void Controller::LimitTorque(Command* command) noexcept {
  const double scale = TorqueScale();
  for (Eigen::Index j = 0; j < command->tau.size(); ++j) {
    const double limit = scale * robot_.model.limits[j].effort;
    double& tau = command->tau[j];
    if (!std::isfinite(tau)) tau = 0;  // Never send NaN or infinity to a motor.
    // Without a limit: infinite if the robot file gives none.
    if (!(limit >= 0 && std::isfinite(limit))) continue;
    // For a joint without a motor (limit 0), the scale of the row is 1 N m.
    const double row_scale = limit > 0 ? limit : 1;
    const double slack = (std::abs(tau) - limit) / row_scale;
    Relax({torque_limits_, static_cast<int>(j),
           tau > 0 ? Side::kUpper : Side::kLower,
           stack_.settings(torque_limits_).level, slack, slack});
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
