// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "poise/dynamics/integrate.h"
#include "poise/hqp/hierarchy.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/task.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {

/// Evaluates tasks in one tick of the humanoid. It is in its nominal posture,
/// and base and all joints move.
class TaskTest : public testing::Test {
 protected:
  TaskTest() {
    state_ = {0, robot_.q_nominal, Eigen::VectorXd(nv_)};
    for (int i = 0; i < nv_; ++i) state_.v[i] = Uniform(-0.3, 0.3);
    Command command;
    command.tau.setZero(n_);
    controller_.Start(state_);
    state_.time = 1e-3;
    controller_.Update(state_, &command);
  }

  double Uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  TaskInput input() const {
    return {state_, controller_.tick(), controller_.contacts(),
            controller_.reference(), unmodelled_vdot_};
  }

  /// Returns the rows of a task, written into a hierarchy of its own.
  const Hierarchy& Write(const Task& task) {
    const int equalities = static_cast<int>(task.equality_names().size());
    const int inequalities = static_cast<int>(task.inequality_names().size());
    hierarchy_ = Hierarchy(nv_ + 12, {{equalities, inequalities}});
    hierarchy_.Clear(1);
    EqualityBlock equal = hierarchy_.AddEqualities(0, equalities);
    InequalityBlock unequal = hierarchy_.AddInequalities(0, inequalities);
    task.Write(input(), &equal, &unequal);
    return hierarchy_;
  }

  Eigen::VectorXd Residual(const Task& task, const Eigen::VectorXd& y) {
    const Hierarchy& rows = Write(task);
    return rows.B(0) * y + rows.b(0);
  }

  /// Returns the tick after the time t with the accelerations v̇ of y.
  Tick After(double t, const Eigen::VectorXd& y) {
    State state{1, robot_.q_nominal, state_.v + t * y.head(nv_)};
    Integrate(tree_, state_.q, state_.v, t, state.q);
    Controller probe(robot_);
    probe.Start(state);
    return probe.tick();
  }

  Eigen::VectorXd RandomY() {
    Eigen::VectorXd y(nv_ + 12);
    for (int i = 0; i < y.size(); ++i) y[i] = Uniform(-1, 1);
    return y;
  }

  std::mt19937 random_{7};
  Robot robot_ = LoadHumanoid();
  const Tree& tree_ = robot_.model.tree;
  const int nv_ = tree_.nv(), n_ = tree_.num_joints();
  const Eigen::Vector2d half_ = robot_.feet[0].half_size;
  Controller controller_{robot_};
  State state_;
  Eigen::VectorXd unmodelled_vdot_ = Eigen::VectorXd::Zero(nv_);
  Hierarchy hierarchy_{1, {{1, 1}}};
};

}  // namespace poise
