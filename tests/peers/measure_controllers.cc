// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Replays recorded states of our humanoid with Poise's controller and with the
// controllers of peers:
//   measure_controllers FILE HAS_LIMITS PASSES
// Prints a line for each controller and tick: the name, the CPU time of the
// fastest pass [us], 1 if all passes report a solution or else 0, and the
// relative residual of the dynamics.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/robot/control/torque.h"
#include "poise/tests/peers/peer_controller.h"
#include "poise/tests/peers/state_file.h"
#include "poise/tests/peers/thread_time.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

struct TickResult {
  double time = std::numeric_limits<double>::infinity();  // [us]
  bool is_solved = true;
  double residual = 0;
};

// The results by controller and tick.
using Results = std::vector<std::vector<TickResult>>;

// Controls all ticks once. The controllers take turns: each one controls all
// ticks, then the next one does.
void RunPass(const ControllerSetup& setup, const std::vector<State>& states,
             Results* results) {
  const auto controllers = MakeControllers(setup);
  for (size_t c = 0; c < controllers.size(); ++c) {
    for (size_t i = 0; i < states.size(); ++i) {
      TickResult& result = (*results)[c][i];
      controllers[c]->Load(states[i]);
      const double start = ThreadTime();
      const bool is_solved = controllers[c]->Update();
      result.time = std::min(result.time, ThreadTime() - start);
      result.is_solved = result.is_solved && is_solved;
    }
  }
}

// Evaluates answers with Poise's dynamics of the same state.
class Judge {
 public:
  explicit Judge(const ControllerSetup& setup)
      : controller_(setup.robot),
        tau_(setup.robot.model.tree.num_joints()),
        weight_(setup.robot.model.tree.total_mass() *
                setup.robot.model.tree.gravity_W().norm()) {
    command_.tau.setZero(tau_.size());
    controller_.Start(setup.start);
  }

  void Load(const State& state) {
    controller_.Update(state, &command_);
    contacts_ = controller_.contacts();
    // The answer of Poise has no force at a foot in the air, but a peer's may.
    for (ContactTick& contact : contacts_) contact.in_contact = true;
  }

  // Returns the larger one of two relative residuals: that of the unactuated
  // rows, and that of the torques. NaN if one is NaN.
  double Residual(const ControllerAnswer& answer) {
    const Tick& tick = controller_.tick();
    const double unactuated =
        DynamicsResidual(tick, contacts_, answer.y, weight_);
    if (answer.tau.size() == 0) return unactuated;
    ComputeTorque(tick, contacts_, answer.y, &tau_);
    const double actuated = (answer.tau - tau_).norm() / tau_.norm();
    return std::isnan(actuated) || actuated > unactuated ? actuated
                                                         : unactuated;
  }

 private:
  Controller controller_;
  Command command_;
  std::vector<ContactTick> contacts_;
  Eigen::VectorXd tau_;
  double weight_;
};

// The residuals are computed in a pass of their own, so that they do not
// change what is in the cache when a tick is timed.
void FindResiduals(const ControllerSetup& setup,
                   const std::vector<State>& states, Results* results) {
  const auto controllers = MakeControllers(setup);
  Judge judge(setup);
  for (size_t i = 0; i < states.size(); ++i) {
    judge.Load(states[i]);
    for (size_t c = 0; c < controllers.size(); ++c) {
      controllers[c]->Load(states[i]);
      (void)controllers[c]->Update();
      (*results)[c][i].residual = judge.Residual(controllers[c]->answer());
    }
  }
}

void Measure(char** argv) {
  const std::vector<State> states = ReadStates(argv[1]);
  const Robot robot = LoadHumanoid();
  const ControllerSetup setup = {robot, states.front(),
                                 std::stoi(argv[2]) != 0};
  const auto controllers = MakeControllers(setup);
  Results results(controllers.size(), std::vector<TickResult>(states.size()));
  const int passes = std::stoi(argv[3]);
  for (int pass = 0; pass < passes; ++pass) RunPass(setup, states, &results);
  FindResiduals(setup, states, &results);
  for (size_t c = 0; c < controllers.size(); ++c) {
    for (const TickResult& result : results[c]) {
      std::printf("%s %.3f %d %.3g\n", controllers[c]->name(), result.time,
                  result.is_solved, result.residual);
    }
  }
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "measure_controllers: " << argc - 1
              << " arguments, want 3: FILE HAS_LIMITS PASSES\n";
    return 2;
  }
  try {
    poise::Measure(argv);
  } catch (const std::exception& error) {
    std::cerr << "measure_controllers: " << error.what() << "\n";
    return 2;
  }
}
