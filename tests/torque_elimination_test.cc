// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solution.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/stance.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/random_tree.h"

namespace poise {
namespace {

// The controller's problem before (10) eliminates the torques. Its variables
// are
//     x = [v̇ (n + 6); lambda (12); tau (n)].
// All n + 6 rows of the dynamics are in priority level 1, and the effort limits
// are bounds on tau. The rows of the other tasks are the controller's own, but
// (9), (10) and the rows of the torque limits are not used.
class UneliminatedProblem {
 public:
  explicit UneliminatedProblem(const Controller& controller);

  int num_variables() const { return ny_ + n_; }

  Solution Solve(const State& state);

 private:
  // M v̇ + N = S' tau + J' lambda.
  void AddDynamics();

  // Adds the limits to priority level 2, in units of the limit.
  void AddTorqueLimits();

  // Adds the rows of a task that does not depend on tau.
  void AddTask(const Task& task, const TaskSettings& settings,
               const TaskInput& input);

  const Controller& controller_;
  const Tree& tree_;
  int nv_, n_, ny_;
  std::vector<LevelCapacity> capacity_;
  Hierarchy hierarchy_;
};

UneliminatedProblem::UneliminatedProblem(const Controller& controller)
    : controller_(controller),
      tree_(controller.robot().model.tree),
      nv_(tree_.nv()),
      n_(tree_.num_joints()),
      ny_(static_cast<int>(controller.report().y.size())),
      capacity_(Stack::kMaxLevel, {nv_ + 200, n_ + 1000}),
      hierarchy_(ny_ + n_, capacity_) {}

Solution UneliminatedProblem::Solve(const State& state) {
  hierarchy_.Clear(5);
  AddDynamics();
  AddTorqueLimits();
  const Stack& stack = controller_.stack();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(state.v.size());
  const TaskInput input{state, controller_.tick(), controller_.contacts(),
                        controller_.reference(), none};
  for (int i = 0; i < stack.num_tasks(); ++i) {
    const Task& task = stack.task(i);
    if (!stack.settings(i).enabled || !task.HasRows(input)) continue;
    if (task.name() == "newton_euler" || task.name() == "torque_limits") {
      continue;
    }
    AddTask(task, stack.settings(i), input);
  }
  Solution solution(num_variables(), capacity_);
  Cascade cascade(num_variables(), capacity_);
  EXPECT_EQ(cascade.Solve(hierarchy_, &solution), Status::kOptimal);
  return solution;
}

void UneliminatedProblem::AddDynamics() {
  const Tick& tick = controller_.tick();
  EqualityBlock rows = hierarchy_.AddEqualities(0, nv_);
  rows.B.leftCols(nv_) = tick.M;
  for (int i = 0; i < static_cast<int>(controller_.contacts().size()); ++i) {
    rows.B.middleCols<6>(nv_ + 6 * i) =
        -controller_.contacts()[i].J_WC_C.transpose();
  }
  rows.B.bottomRightCorner(n_, n_).diagonal().setConstant(-1);
  rows.b = tick.N;
}

void UneliminatedProblem::AddTorqueLimits() {
  InequalityBlock rows = hierarchy_.AddInequalities(1, n_);
  for (int j = 0; j < n_; ++j) {
    const double effort = controller_.robot().model.limits[j].effort;
    rows.C(j, ny_ + j) = 1 / effort;
    rows.lower[j] = -1;
    rows.upper[j] = 1;
  }
}

void UneliminatedProblem::AddTask(const Task& task,
                                  const TaskSettings& settings,
                                  const TaskInput& input) {
  const int level = settings.level - 1;
  const int equalities = static_cast<int>(task.equality_names().size());
  const int inequalities = static_cast<int>(task.inequality_names().size());
  Hierarchy narrow(ny_, {{equalities, inequalities}});
  narrow.Clear(1);
  EqualityBlock from = narrow.AddEqualities(0, equalities);
  InequalityBlock from_bounds = narrow.AddInequalities(0, inequalities);
  task.Write(input, &from, &from_bounds);
  EqualityBlock to = hierarchy_.AddEqualities(level, equalities);
  to.B.leftCols(ny_) = from.B;
  to.b = from.b;
  to.weight = settings.weight * from.weight;
  InequalityBlock bounds = hierarchy_.AddInequalities(level, inequalities);
  const double scale = std::sqrt(settings.weight);
  bounds.C.leftCols(ny_) = scale * from_bounds.C;
  bounds.lower = scale * from_bounds.lower;
  bounds.upper = scale * from_bounds.upper;
}

class TorqueEliminationTest : public testing::Test {
 protected:
  TorqueEliminationTest() {
    state_ = {0, robot_.q_nominal, Eigen::VectorXd::Zero(tree().nv())};
    MakeController();
    command_.tau.setZero(tree().num_joints());
  }

  const Tree& tree() const { return robot_.model.tree; }

  void MakeController() {
    controller_ = std::make_unique<Controller>(robot_);
    // The input in Solve() has no integral correction and no capture blend.
    (void)controller_->stack().SetParameter("momentum", "ki", 0);
    (void)controller_->stack().SetParameter("momentum", "ki_height", 0);
    (void)controller_->stack().SetParameter("momentum", "capture", 0);
    controller_->Start(state_);
  }

  // Lifts the other foot within three ticks.
  void StandOn(int foot) {
    state_.v.setZero();
    MakeController();
    StanceSettings settings;
    settings.fade_time = 1e-3;
    controller_->stance().Configure(settings);
    ASSERT_TRUE(controller_->stance().Lift(1 - foot, 0.05));
    for (int tick = 0; tick < 3; ++tick) {
      state_.time += 1e-3;
      controller_->Update(state_, &command_);
    }
    ASSERT_EQ(controller_->stance().phase(1 - foot), ContactPhase::kUp);
  }

  // Compares v̇, lambda and tau of one tick.
  void ExpectSameAnswer() {
    state_.time += 1e-3;
    controller_->Update(state_, &command_);
    ASSERT_NE(command_.status, TickStatus::kFailSafe);
    UneliminatedProblem problem(*controller_);
    ASSERT_EQ(problem.num_variables(), 2 * tree().num_joints() + 6 + 12);
    const Eigen::VectorXd x = problem.Solve(state_).y;

    const Eigen::VectorXd& y = controller_->report().y;
    const int nv = tree().nv();
    // Absolute tolerance, in rad/s2, m/s2, N and N m. It is the rounding error
    // of 400 N times the condition number 1e4, which comes from a force
    // regularizer of weight 1e-2 next to the posture.
    const auto expect_near = [](const Eigen::VectorXd& a,
                                const Eigen::VectorXd& b, const char* what) {
      EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), 1e-9) << what;
    };
    expect_near(y.head(nv), x.head(nv), "v̇");
    expect_near(y.segment(nv, 12), x.segment(nv, 12), "lambda");
    expect_near(command_.tau, x.tail(tree().num_joints()), "tau");
  }

  int num_active() const {
    return static_cast<int>(controller_->report().active.size());
  }

  Robot robot_ = LoadHumanoid();
  std::unique_ptr<Controller> controller_;
  State state_;
  Command command_;
};

TEST_F(TorqueEliminationTest, AgreesWhenStandingStill) { ExpectSameAnswer(); }

TEST_F(TorqueEliminationTest, AgreesWhenMovingInAnyPosture) {
  std::mt19937 draw(1);
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    state_.q = robot_.q_nominal;
    state_.q.tail(tree().num_joints()) +=
        0.05 * MakeRandomVector(tree().num_joints(), &draw);
    state_.v = 0.2 * MakeRandomVector(tree().nv(), &draw);
    // A jump of v would count as an unmodelled acceleration, which the input in
    // Solve() does not have.
    controller_->Start(state_);
    ExpectSameAnswer();
  }
}

TEST_F(TorqueEliminationTest, AgreesWithActiveInequalities) {
  state_.v[4] = 0.35;  // m/s, to the left: a strong push.
  ExpectSameAnswer();
  EXPECT_GT(num_active(), 0);
}

TEST_F(TorqueEliminationTest, AgreesOnOneLeg) {
  std::mt19937 draw(2);
  for (const int stance : {0, 1}) {
    for (const double speed : {0.0, 0.2}) {
      SCOPED_TRACE(robot_.feet[stance].name);
      SCOPED_TRACE(speed);
      StandOn(stance);
      state_.v = speed * MakeRandomVector(tree().nv(), &draw);
      ExpectSameAnswer();
      const TickReport& report = controller_->report();
      EXPECT_GT(report.foot_wrench(tree().nv(), stance)[5], 100);  // N.
      EXPECT_TRUE(report.foot_wrench(tree().nv(), 1 - stance).isZero());
    }
  }
}

TEST_F(TorqueEliminationTest, AgreesWithActiveTorqueLimits) {
  for (JointLimits& limits : robot_.model.limits) limits.effort *= 0.3;
  MakeController();
  state_.v[4] = 0.25;
  ExpectSameAnswer();
  const int limits = *controller_->stack().Find("torque_limits");
  int active_limits = 0;
  for (const ActiveRow& row : controller_->report().active) {
    active_limits += row.task == limits;
  }
  EXPECT_GT(active_limits, 0);
}

}  // namespace
}  // namespace poise
