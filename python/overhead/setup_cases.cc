// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Calls that a program makes once, before its loop.
#include <memory>
#include <string>

#include "poise/dynamics/tree.h"
#include "poise/hqp/hierarchy.h"
#include "poise/hqp/solution.h"
#include "poise/hqp/solver.h"
#include "poise/python/overhead/cases.h"
#include "poise/robot/control/conflict.h"
#include "poise/robot/control/controller.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/control/task_set.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/scenario.h"
#include "poise/tools/commands/doctor/diagnose.h"

namespace poise {
namespace {

void AddRobot(const Robot& robot, const std::string& urdf,
              const Profile& profile, std::vector<TimedCase>* cases) {
  cases->push_back({"Robot.load", [&profile, urdf] {
                      Keep(LoadStandingRobot(urdf, LoadProfile(profile.file)));
                    }});
  cases->push_back({"Robot.doctor", [&profile, urdf] {
                      Keep(Diagnose(urdf, LoadProfile(profile.file)));
                    }});
  cases->push_back({"Tree.with_base", [&robot] {
                      Keep(robot.model.tree.WithBase(BaseType::kFixed));
                    }});
}

// Two levels in one variable that contradict each other, as in measure.py.
void AddHierarchy(std::vector<TimedCase>* cases) {
  const std::vector<LevelCapacity> sizes = {{0, 1}, {1, 0}};
  const auto make = [sizes] {
    auto hierarchy = std::make_shared<Hierarchy>(1, sizes);
    InequalityBlock limit = hierarchy->AddInequalities(0, 1);
    limit.C(0, 0) = 1;
    limit.upper[0] = 1;
    EqualityBlock target = hierarchy->AddEqualities(1, 1);
    target.B(0, 0) = 1;
    target.b[0] = -3;
    target.weight[0] = 1;
    hierarchy->FindSpans();
    return hierarchy;
  };
  cases->push_back({"Hierarchy", [make] { Keep(make()); }});
  const std::shared_ptr<Hierarchy> hierarchy = make();
  cases->push_back({"Solution.conflict",
                    [hierarchy] { Keep(FindConflict(*hierarchy, 1)); }});
}

void AddController(const Robot& robot, const Profile& profile,
                   std::vector<TimedCase>* cases) {
  const auto make = [&robot, &profile] {
    auto controller = std::make_shared<Controller>(robot);
    if (profile.tasks.IsDefined()) {
      ApplyTasks(profile.tasks, profile.file, &controller->stack());
    }
    return controller;
  };
  cases->push_back({"Controller", [make] { Keep(make()); }});
  const int nv = robot.model.tree.nv();
  const auto state = std::make_shared<State>(
      State{0, robot.q_nominal, Eigen::VectorXd::Zero(nv)});
  const std::shared_ptr<Controller> controller = make();
  cases->push_back(
      {"Controller.start", [controller, state] { controller->Start(*state); }});
  cases->push_back(
      {"State", [state] { Keep(std::make_shared<State>(*state)); }});
}

void AddScenario(const Robot& robot, const Profile& profile,
                 const std::string& stand, std::vector<TimedCase>* cases) {
  cases->push_back({"Scenario.load", [stand] { Keep(LoadScenario(stand)); }});
  cases->push_back({"Scenario.from_dict", [] {
                      const Scenario scenario = ParseScenario(
                          "{\"duration\": 3}", "scenario", "scenario");
                      Validate(scenario);
                      Keep(scenario);
                    }});
  Scenario scenario;
  UseTasksOf(profile, &scenario);
  cases->push_back({"Simulation", [&robot, scenario] {
                      Keep(std::make_unique<ClosedLoop>(robot, scenario));
                    }});
}

}  // namespace

void AddSetupCases(const Robot& robot, const std::string& urdf,
                   const Profile& profile, const std::string& stand,
                   std::vector<TimedCase>* cases) {
  AddRobot(robot, urdf, profile, cases);
  AddHierarchy(cases);
  AddController(robot, profile, cases);
  AddScenario(robot, profile, stand, cases);
}

}  // namespace poise
