// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "poise/robot/profile/profile.h"
#include "poise/sim/experiment.h"
#include "poise/sim/outcome.h"
#include "poise/sim/scenario.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/studies/strictness_study.h"

namespace poise {
namespace {

Experiment Pushed(const Experiment& strong_push, double force,
                  double direction_deg, double duration) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  Experiment experiment = strong_push;
  Scenario& scenario = experiment.scenario;
  const double angle = direction_deg * kDegree;
  scenario.pushes[0].force = {force * std::cos(angle), force * std::sin(angle),
                              0};
  scenario.pushes[0].duration = duration;
  scenario.duration = 4;
  return experiment;
}

void PrintSameProblems(const Experiment& experiment) {
  std::cout << "| way | momentum [N] | posture [rad/s2] | contacts violated by "
               "[m/s2] | cones violated by | median, p99 [us] | not solved |\n"
               "| --- | --- | --- | --- | --- | --- | --- |\n";
  const std::vector<Weighing> ways = Weighings();
  const std::vector<WeighingResult> results = CompareWeighings(experiment);
  for (size_t i = 0; i < ways.size(); ++i) {
    const WeighingResult& r = results[i];
    std::printf("| %s | %.3g | %.4g | %.1e | %.1e | %.0f, %.0f | %d |\n",
                ways[i].name.c_str(), r.momentum, r.posture, r.contact, r.force,
                r.median_us, r.p99_us, r.failures);
  }
  std::printf("\nTicks with an active constraint: %ld.\n\n", results[0].ticks);
  std::fflush(stdout);  // The next table takes long.
}

void PrintOutcomes(const std::vector<Experiment>& pushes) {
  std::cout << "| way |";
  for (const Experiment& push : pushes) {
    std::printf(" %.0f N, %.2f s |", push.scenario.pushes[0].force.norm(),
                push.scenario.pushes[0].duration);
  }
  std::cout << "\n| --- |";
  for (size_t i = 0; i < pushes.size(); ++i) std::cout << " --- |";
  std::cout << '\n';
  for (const Weighing& way : Weighings()) {
    std::cout << "| " << way.name << " |";
    for (const Experiment& push : pushes) {
      const Verdict verdict = RunWeighing(push, way);
      std::printf(" %s, %.1f mm, tilt %.3f |", Outcome(verdict).c_str(),
                  1e3 * verdict.com_error_peak.head<2>().norm(),
                  verdict.foot_tilt_peak);
      std::cout << std::flush;
    }
    std::cout << '\n';
  }
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Compares strict levels with weights: on the same states, and each in "
      "its "
      "own closed loop. Prints the tables of docs/notebook.",
      "strictness");
  ParseCommandLine(argc, argv, &app);
  const Experiment strong_push{
      LoadRobot("robot/models/humanoid.urdf",
                LoadProfile("robot/profiles/humanoid.yaml")),
      LoadScenario("sim/scenarios/strong_push.yaml")};
  const auto pushed = [&](double force, double direction_deg, double duration) {
    return Pushed(strong_push, force, direction_deg, duration);
  };
  PrintSameProblems(pushed(100, 90, 0.15));
  PrintOutcomes({pushed(50, 90, 0.15), pushed(100, 90, 0.15),
                 pushed(100, 90, 0.18), pushed(100, 0, 0.14),
                 pushed(100, 45, 0.2)});
  return 0;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("strictness", [=] { return poise::Main(argc, argv); });
}
