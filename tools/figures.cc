// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "poise/robot/profile/profile.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/output_folder.h"
#include "poise/tools/commands/push/record_run.h"
#include "poise/tools/studies/figures_draw.h"
#include "poise/tools/studies/step_pictures.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

// Records all runs on all cores, each run into its own folder.
void RecordAll(const std::vector<FigureRun>& runs, const fs::path& folder) {
  std::atomic<std::size_t> next{0}, done{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < runs.size(); i = next++) {
      RecordRun(runs[i].experiment, folder / runs[i].name);
      const std::size_t count = ++done;
      if (isatty(STDERR_FILENO) != 0) {
        std::fprintf(stderr, "\r  %zu of %zu runs%s", count, runs.size(),
                     count == runs.size() ? "\n" : "");
      }
    }
  };
  std::vector<std::future<void>> workers;
  for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) {
    workers.push_back(std::async(std::launch::async, work));
  }
  for (std::future<void>& worker : workers) worker.get();
}

// `bazel run` sets BUILD_WORKSPACE_DIRECTORY. Without it, the current folder is
// the workspace.
fs::path DocsFolder() {
  const char* workspace = std::getenv("BUILD_WORKSPACE_DIRECTORY");
  return workspace ? fs::path(workspace) / "docs/generated"
                   : fs::path("docs/generated");
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Draws figures 3 to 12 of the paper, and a shove with "
      "steps, from new runs.",
      "figures");
  std::string out;
  bool keep_runs = false;
  app.add_option("--out", out,
                 "Folder for results.md and figures/ [docs/generated]");
  app.add_flag("--keep-runs", keep_runs, "Keep the runs, in OUT/figure-runs");
  ParseCommandLine(argc, argv, &app);
  const fs::path folder =
      MakeOutputFolder(out.empty() ? DocsFolder().string() : out);
  const Robot robot = LoadRobot("robot/models/humanoid.urdf",
                                LoadProfile("robot/profiles/humanoid.yaml"));
  const fs::path runs = folder / "figure-runs";
  RecordAll(MakeFigureRuns(robot, "sim/scenarios"), runs);
  DrawShove(robot, runs, folder / "figures");
  WriteResults(DrawFigures(robot, runs, folder / "figures"),
               folder / "results.md", "figures");
  if (!keep_runs) fs::remove_all(runs);
  std::cout << (folder / "results.md").string() << '\n';
  return 0;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("figures", [=] { return poise::Main(argc, argv); });
}
