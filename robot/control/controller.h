// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/robot/control/balance_monitor.h"
#include "poise/robot/control/command.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/control/disturbance.h"
#include "poise/robot/control/measurement.h"
#include "poise/robot/control/reference.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/stance.h"
#include "poise/robot/control/state_guard.h"
#include "poise/robot/control/tasks/com.h"
#include "poise/robot/control/tasks/froude.h"
#include "poise/robot/control/tasks/momentum.h"
#include "poise/robot/control/tick_report.h"
#include "poise/robot/control/torque.h"
#include "poise/robot/control/unmodelled_acceleration.h"
#include "poise/robot/robot.h"

namespace poise {

/// Options of a Controller, fixed at its construction.
struct ControllerOptions {
  double dt = 1e-3;          ///< Time between two updates, s.
  double friction = 0.5;     ///< mu of the tasks friction and yaw.
  bool inscribed = false;    ///< Friction pyramid inside the friction cone.
  bool feedforward = false;  ///< Uses v_WG and a_WG of the reference.
  bool weighted = false;     ///< One weighted QP instead of the hierarchy.
  bool drag_compensation = true;  ///< Adds the torques of DragCompensation.
  int max_iterations = 500;  ///< Solver iterations per tick; then truncated.
  /// Solver::max_modelled_seconds, s; 0: no limit. A replay is exact.
  double max_modelled_seconds = 0;
  /// Time budget of the solver in a tick, s, measured by now(); used only if
  /// now() is given. The result depends on the machine: no replay is exact.
  double max_seconds = 0;
  std::function<double()> now;
  std::vector<std::string> frames;  ///< Links with a task frame.NAME.
  /// Adds tasks of the caller's own to the default stack; may be empty. Called
  /// once, in the constructor.
  std::function<void(Stack*)> add_tasks;
};

/// Computes the joint torques from the state of a robot, by momentum control
/// with hierarchical inverse dynamics.
///
///     Controller controller(robot);
///     controller.Start(states[0]);
///     for (const State& state : states) {
///       controller.reference().p_WG.z() -= 1e-5;  // To move the robot.
///       controller.Update(state, &command);
///     }
///
/// The default hierarchy. stack() switches, moves and tunes any task by name
/// between two ticks; tasks in parentheses are off:
///
///     level  tasks
///     1      newton_euler, no_contact
///     2      torque_limits, joint_limits
///     3      mimic, light_joints, contact, cop, friction, unilateral, yaw,
///            (yaw_constant, zmp, zmp_literal, capture_point), self_collision
///     4      momentum, frame.FOOT,
///            (com, linear_momentum, angular_momentum, frame.LINK)
///     5      posture, force_regularizer, (torque_minimization)
///
/// The tasks mimic and light_joints exist only if the robot has such joints.
/// frame.FOOT has rows only while this foot is in the air.
class Controller {
 public:
  /// Throws std::invalid_argument if the robot has no foot, or an option is out
  /// of its range.
  explicit Controller(const Robot& robot,
                      const ControllerOptions& options = {});

  /// Sets reference() to standing still in the nominal posture, with the feet
  /// where they are in this state. If q or v of the state is invalid, the last
  /// valid state is used. Start() resets everything but the settings of stack()
  /// and stance(), so that a run repeats bit for bit. Does not allocate.
  void Start(const State& state) noexcept;

  Reference& reference() { return reference_; }
  const Reference& reference() const { return reference_; }
  Stack& stack() { return stack_; }
  const Stack& stack() const { return stack_; }
  /// Decides which feet are in contact. Before you lift a foot, shift the
  /// weight to the other foot.
  Stance& stance() { return stance_; }
  const Stance& stance() const { return stance_; }

  /// Computes the torques of one tick. Never throws, allocates or waits. For
  /// every state, even an invalid one, the torques are finite and inside the
  /// effort limits; see TickStatus.
  /// pre: command->tau has one entry per joint.
  void Update(const State& state, Command* command) noexcept;

  /// Report on the last Update(): its status and its findings.
  const TickReport& report() const { return report_; }
  const Tick& tick() const { return tick_; }
  const std::vector<ContactTick>& contacts() const { return contacts_; }
  /// Measured minus predicted v̇, see UnmodelledAcceleration.
  const Eigen::VectorXd& unmodelled_vdot() const { return unmodelled_.vdot(); }
  /// The problem of the last tick, for FindConflict().
  const Hierarchy& hierarchy() const { return hierarchy_; }
  const Robot& robot() const { return robot_; }

 private:
  // The steps of Update(), in their order.
  FailSafeReason AcceptState(const State& state) noexcept;
  void ComputeModel(const State& state) noexcept;
  void UpdateStance(const State& state) noexcept;
  void WriteTasks(const State& state) noexcept;
  [[nodiscard]] bool Solve() noexcept;
  void ComputeCommand(const State& state, Command* command) noexcept;

  void JudgeBalance() noexcept;
  void Remember(const State& state) noexcept;
  void FailSafe(FailSafeReason reason, const State& state,
                Command* command) noexcept;
  double TorqueScale() const noexcept;
  void LimitTorque(Command* command) noexcept;
  void Relax(const ActiveRow& row) noexcept;
  void EstimateDisturbance() noexcept;

  Robot robot_;
  ControllerOptions options_;
  double weight_;       ///< Weight of the robot, N.
  double force_scale_;  ///< Scale of rows in forces, N.
  FroudeScale scale_;
  Reference reference_;
  Stack stack_;
  int momentum_;  ///< Index into the stack's tasks.
  const MomentumTask& momentum_task_;
  int torque_limits_, joint_limits_;  ///< Indices into the tasks.
  int com_;                           ///< Index into the tasks.
  const ComTask& com_task_;
  StateGuard guard_;
  Stance stance_;
  BalanceMonitor monitor_;
  DragCompensation drag_;
  Tick tick_;
  std::vector<ContactTick> contacts_;
  Hierarchy hierarchy_;
  Solver solver_;
  Solution solution_;
  TickReport report_;
  Eigen::VectorXd normal_force_;  ///< By foot, from the last solution, N.

  Pose X_MidB_;             ///< Nominal base, in the mid-feet frame.
  Eigen::Vector3d p_MidG_;  ///< Nominal center of mass, same frame.
  Disturbance disturbance_;
  UnmodelledAcceleration unmodelled_;
};

}  // namespace poise
