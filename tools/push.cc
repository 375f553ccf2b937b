// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <string>

#include "poise/robot/finding.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/log/summary.h"
#include "poise/sim/scenario.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/interruption.h"
#include "poise/tools/commands/push/dump_solve.h"
#include "poise/tools/commands/push/push_options.h"
#include "poise/tools/commands/push/record_run.h"
#include "poise/tools/commands/push/warnings.h"
#include "poise/tools/commands/report/report_page.h"

namespace {

bool ShowProgress(double fraction) {
  static int shown = -1;
  const int percent = static_cast<int>(100 * fraction);
  if (percent != shown && isatty(STDERR_FILENO) != 0) {
    shown = percent;
    std::fprintf(stderr, "\r  simulated %3d %%%s", percent,
                 fraction < 1 ? "" : "\r                  \r");
  }
  return !poise::IsInterrupted();
}

int Push(const poise::PushOptions& options) {
  const poise::Robot& robot = options.loop->robot();
  const poise::Scenario& scenario = options.loop->scenario();
  std::string dumped;
  if (options.dumped) {
    dumped = "\nTo solve again: " +
             poise::SolveAgain(scenario.control, *options.dumped,
                               poise::DumpSolve({robot, scenario},
                                                *options.dumped, options.out));
  }
  poise::CatchInterruption();
  const auto [result, step_Ns, files] = poise::RecordRun(
      options.loop.get(), options.out, ShowProgress, options.log);
  if (options.report) {
    poise::WriteRunReport(files, options.out / "report.html");
  }
  if (options.json) {
    std::cout << poise::ToJson(robot, scenario, result, step_Ns).dump(2)
              << '\n';
  } else {
    std::cout << poise::ToTable(robot, scenario, result, step_Ns)
              << "\nWritten to " << options.out.string() << dumped << '\n';
  }
  const bool is_done = result.commanded_done.value_or(true);
  return result.verdict.recovered && is_done && !result.interrupted ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return poise::RunTool("push", [=] {
    const poise::PushOptions options = poise::ReadPushOptions(argc, argv);
    poise::PrintWarnings(options.robot_file.string(), options.loop->robot(),
                         options.findings);
    const std::string late =
        poise::BudgetWarning(options.loop->scenario().control);
    if (!late.empty()) std::cerr << late << "\n";
    return Push(options);
  });
}
