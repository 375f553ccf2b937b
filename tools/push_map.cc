// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/interruption.h"
#include "poise/tools/commands/push_map/push_map_options.h"
#include "poise/tools/commands/push_map/push_map_run.h"

namespace {

bool ShowProgress(const poise::PushMapProgress& progress) {
  if (isatty(STDERR_FILENO) != 0) {
    char left[40] = "";
    if (progress.seconds_left >= 0) {
      std::snprintf(left, sizeof left, ", %.0f min %02.0f s left",
                    std::floor(progress.seconds_left / 60),
                    std::fmod(progress.seconds_left, 60));
    }
    std::fprintf(stderr, "\r\033[K  %d of %d points, %d pushes tried%s",
                 progress.points_done, progress.points, progress.trials, left);
    if (progress.points_done == progress.points) std::fputc('\n', stderr);
  }
  return !poise::IsInterrupted();
}

void PrintTable(const poise::PushMapPlan& plan,
                const poise::PushMapFiles& files) {
  std::printf("%10s %9s %12s %12s %6s", "direction", "duration", "recovered",
              "pendulum", "eta");
  if (plan.scan) {
    std::printf(" %12s %6s %12s %6s", "one step", "eta", "steps from", "holes");
  }
  std::printf("  tasks\n");
  for (const auto& [point, value] : files.found()) {
    std::printf("%8.1f deg %7.3f s %9.2f Ns %9.2f Ns %6.2f",
                point.direction_deg, point.duration, value.impulse, value.lipm,
                value.impulse / value.lipm);
    if (value.steps) {
      std::printf(" %9.2f Ns %6.2f %9.2f Ns %6zu", value.steps->step_Ns,
                  value.impulse / value.steps->step_Ns, value.steps->first,
                  value.steps->holes.size());
    }
    std::printf("  %s\n", point.tasks.c_str());
  }
  std::printf("\n%s\n", (plan.folder / "map.html").c_str());
}

int Map(const poise::PushMapOptions& options) {
  const poise::PushMapPlan& plan = options.plan;
  poise::PushMapFiles files(plan.folder, options.settings, options.header,
                            plan.scan);
  const bool all = poise::RunPushMap(plan, &files, ShowProgress);
  poise::WriteMapPage(plan, files);
  if (!all) {
    std::cerr
        << "\npush_map: interrupted; run the same command again to continue\n";
    return 1;
  }
  if (options.json) {
    std::cout << poise::MapToJson(plan, files).dump(1) << '\n';
  } else {
    PrintTable(plan, files);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return poise::RunTool("push_map", [=] {
    const poise::PushMapOptions options = poise::ReadPushMapOptions(argc, argv);
    poise::CatchInterruption();
    return Map(options);
  });
}
