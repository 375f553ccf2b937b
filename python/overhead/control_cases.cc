// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Core>
#include <limits>
#include <memory>

#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/python/overhead/cases.h"
#include "poise/robot/control/command.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/task_set.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/scenario.h"

namespace poise {
namespace {

// Two levels in 20 variables: y <= 0.1, then y near a vector, as in measure.py.
void AddSolver(std::vector<TimedCase>* cases) {
  constexpr int kSize = 20;
  const std::vector<LevelCapacity> sizes = {{0, kSize}, {kSize, 0}};
  auto hierarchy = std::make_shared<Hierarchy>(kSize, sizes);
  InequalityBlock limits = hierarchy->AddInequalities(0, kSize);
  limits.C.setIdentity();
  limits.lower.setConstant(-std::numeric_limits<double>::infinity());
  limits.upper.setConstant(0.1);
  EqualityBlock target = hierarchy->AddEqualities(1, kSize);
  target.B.setIdentity();
  target.b = Eigen::VectorXd::LinSpaced(kSize, -1, 1);
  target.weight.setOnes();
  hierarchy->FindSpans();
  auto solver = std::make_shared<Solver>(kSize, sizes);
  auto solution = std::make_shared<Solution>(kSize, sizes);
  cases->push_back({"Solver.solve",
                    [=] { Keep(solver->Solve(*hierarchy, solution.get())); }});
}

// Stands still, with a new time in each tick.
void AddController(const Robot& robot, const Profile& profile,
                   std::vector<TimedCase>* cases) {
  auto controller = std::make_shared<Controller>(robot);
  if (profile.tasks.IsDefined()) {
    ApplyTasks(profile.tasks, profile.file, &controller->stack());
  }
  const int nv = robot.model.tree.nv();
  auto state = std::make_shared<State>(
      State{0, robot.q_nominal, Eigen::VectorXd::Zero(nv)});
  controller->Start(*state);
  auto command = std::make_shared<Command>();
  command->tau.setZero(robot.model.tree.num_joints());
  cases->push_back({"Controller.update", [=] {
                      state->time += 1e-3;
                      controller->Update(*state, command.get());
                    }});
}

void AddSimulation(const Robot& robot, const Profile& profile,
                   std::vector<TimedCase>* cases) {
  Scenario scenario;
  UseTasksOf(profile, &scenario);
  auto loop = std::make_shared<ClosedLoop>(robot, scenario);
  cases->push_back({"Simulation.step", [=] { loop->Tick(); }});
}

}  // namespace

void AddControlCases(const Robot& robot, const Profile& profile,
                     std::vector<TimedCase>* cases) {
  AddSolver(cases);
  AddController(robot, profile, cases);
  AddSimulation(robot, profile, cases);
}

}  // namespace poise
