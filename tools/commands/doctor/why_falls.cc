// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/why_falls.h"

#include <chrono>
#include <ctime>
#include <stdexcept>

#include "poise/robot/finding.h"
#include "poise/sim/experiment.h"
#include "poise/sim/run.h"
#include "poise/sim/scenario.h"

namespace poise {
namespace {

// The CoM has reached its target after this time, s.
constexpr double kSettled = 5;
// Real time over processor time, if other programs use the processor too.
constexpr double kLongestWait = 1.6;

// Returns the scenario of sim/scenarios/stand.yaml, shorter. The doctor may run
// outside of the folder of scenarios.
Scenario MakeStand(double duration) {
  Scenario scenario;
  scenario.name = "stand";
  scenario.duration = duration;
  scenario.chosen_for = ChosenFor{38.66, 0.7924};
  scenario.start.joints = 0.1;
  scenario.start.drop = 0.002;
  return scenario;
}

}  // namespace

std::optional<std::string> WhyFalls(const Robot& robot, const Profile& profile,
                                    double duration, double longest) {
  using Clock = std::chrono::steady_clock;
  Scenario scenario = MakeStand(duration);
  UseTasksOf(profile, &scenario);
  const Clock::time_point start = Clock::now();
  const std::clock_t computed = std::clock();
  const auto has_time = [&](double) {
    const std::chrono::duration<double> waited = Clock::now() - start;
    const double seconds =
        static_cast<double>(std::clock() - computed) / CLOCKS_PER_SEC;
    return waited.count() < kLongestWait * longest && seconds < longest;
  };
  try {
    const RunResult result = Run(robot, scenario, {}, has_time);
    if (result.verdict.fell_at) {
      return "it falls after " + PrintNumber(*result.verdict.fell_at) +
             " s of the scenario stand: " + FellBy(result);
    }
    if (result.interrupted) return std::nullopt;
    if (result.verdict.recovered || duration < kSettled) return "";
    return "its center of mass ends " +
           PrintNumber(result.verdict.com_error_final.head<2>().norm()) +
           " m from its target in the scenario stand";
  } catch (const std::invalid_argument& error) {
    return "the scenario stand cannot be run: " + OneLine(error.what());
  }
}

}  // namespace poise
