// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/strictness_study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>

#include "poise/robot/control/command.h"
#include "poise/robot/control/controller.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/observation.h"

namespace poise {
namespace {

constexpr const char* kForceTasks[] = {"cop", "friction", "unilateral", "yaw"};
// Multipliers below this are rounding errors.
constexpr double kActs = 1e-6;

// Puts the tasks below the constraints into one level. `weight` multiplies the
// weights of the lower tasks.
void PutTasksTogether(Stack* stack, double weight) {
  for (const char* task : {"posture", "force_regularizer"}) {
    const double own = stack->settings(*stack->Find(task)).weight;
    (void)stack->SetLevel(task, 4);
    (void)stack->SetWeight(task, own * weight);
  }
}

const TaskReport& Of(const Controller& controller, std::string_view task) {
  return controller.report().tasks[*controller.stack().Find(task)];
}

bool HasActiveForce(const Controller& controller) {
  for (const ActiveRow& row : controller.report().active) {
    if (row.multiplier < kActs) continue;
    for (const char* task : kForceTasks) {
      if (row.task == *controller.stack().Find(task)) return true;
    }
  }
  return false;
}

// A controller that uses one way. It computes the same ticks as the controller
// in the loop, but its torques are not applied.
struct Bystander {
  std::unique_ptr<Controller> controller;
  Command command;
  WeighingResult result;
  std::vector<double> us;

  void Update(const State& state) {
    using Clock = std::chrono::steady_clock;
    const auto before = Clock::now();
    controller->Update(state, &command);
    us.push_back(
        std::chrono::duration<double, std::micro>(Clock::now() - before)
            .count());
  }

  void Count(bool is_active, double mass) {
    const TickReport& report = controller->report();
    if (report.status == TickStatus::kTruncated ||
        report.status == TickStatus::kFailSafe) {
      ++result.failures;
    }
    result.contact =
        std::max(result.contact, Of(*controller, "contact").residual);
    for (const char* task : kForceTasks) {
      result.force = std::max(result.force, Of(*controller, task).slack);
    }
    if (!is_active) return;
    ++result.ticks;
    const double momentum = mass * Of(*controller, "momentum").residual;
    const double posture = Of(*controller, "posture").residual;
    result.momentum += momentum * momentum;
    result.posture += posture * posture;
  }

  void Finish() {
    const auto n = static_cast<double>(std::max(1L, result.ticks));
    result.momentum = std::sqrt(result.momentum / n);
    result.posture = std::sqrt(result.posture / n);
    std::sort(us.begin(), us.end());
    if (us.empty()) return;
    result.median_us = us[us.size() / 2];
    result.p99_us = us[us.size() * 99 / 100];
  }
};

}  // namespace

std::vector<Weighing> Weighings() {
  const auto one_qp = [](double ratio) {
    return [ratio](Stack* stack) { (void)stack->set_weighted(true, ratio); };
  };
  const auto two_levels = [](double weight) {
    return [weight](Stack* stack) { PutTasksTogether(stack, weight); };
  };
  return {{"strict, five levels", [](Stack*) {}},
          {"tasks weighted, 1 : 1e-2", two_levels(1e-2)},
          {"tasks weighted, 1 : 1e-4", two_levels(1e-4)},
          {"one QP, 10 a level", one_qp(10)},
          {"one QP, 100 a level", one_qp(100)},
          {"one QP, 1000 a level", one_qp(1000)}};
}

std::vector<WeighingResult> CompareWeighings(const Experiment& experiment) {
  const auto& [robot, scenario] = experiment;
  ClosedLoop loop(robot, scenario);
  std::vector<Bystander> bystanders;
  for (const Weighing& weighing : Weighings()) {
    Bystander one{
        std::make_unique<Controller>(robot, ControllerOptions()), {}, {}, {}};
    weighing.arrange(&one.controller->stack());
    one.command.tau.setZero(robot.model.tree.num_joints());
    bystanders.push_back(std::move(one));
  }
  const auto ticks =
      static_cast<long>(std::lround(scenario.duration / scenario.control.dt));
  for (long k = 0; k < ticks; ++k) {
    const PlantState start = loop.plant().Sense();
    loop.Tick();
    const State state{start.time, start.q, start.v};
    const bool is_active = HasActiveForce(loop.controller());
    for (Bystander& one : bystanders) {
      if (k == 0) one.controller->Start(state);
      one.controller->reference() = loop.controller().reference();
      one.Update(state);
      one.Count(is_active, robot.model.tree.total_mass());
    }
  }
  std::vector<WeighingResult> results;
  for (Bystander& one : bystanders) {
    one.Finish();
    results.push_back(one.result);
  }
  return results;
}

Verdict RunWeighing(const Experiment& experiment, const Weighing& weighing) {
  const auto& [robot, scenario] = experiment;
  ClosedLoop loop(robot, scenario);
  weighing.arrange(&loop.controller().stack());
  Judge judge(StandingHeight(robot));
  while (loop.time() < scenario.duration - scenario.control.dt / 2 &&
         !judge.is_down()) {
    loop.Tick();
    judge.Look(loop.observation());
  }
  return judge.Conclude();
}

}  // namespace poise
