// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/keep_inputs.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/report/report_page.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

// Returns the files of the runs, which the page must not replace.
std::vector<InputFile> FilesOf(
    const std::vector<std::filesystem::path>& folders) {
  std::vector<InputFile> files;
  for (const std::filesystem::path& folder : folders) {
    for (const char* name :
         {"log.csv", "log.bin", "timing.csv", "summary.json", "robot.json"}) {
      files.push_back({folder / name, std::string(name) + " of a run"});
    }
  }
  return files;
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Writes one HTML page that shows a run, or two runs side by side at the "
      "same time. The page needs no server.",
      "report");
  std::vector<std::string> runs;
  std::string out;
  std::vector<std::string> packages;
  app.add_option("RUN_DIR", runs,
                 "The folder of a run, or two folders to compare")
      ->required()
      ->expected(1, 2);
  app.add_option(
      "--out", out,
      "The page to write [RUN_DIR/report.html, or ./compare.html for "
      "two runs]");
  AddPackagePath(&app, &packages);
  ParseCommandLine(argc, argv, &app);
  std::vector<std::filesystem::path> folders;
  for (const std::string& run : runs) {
    folders.push_back(UserPath(run));
  }
  KeepInputs(out, FilesOf(folders));
  std::filesystem::path html = UserPath("compare.html");
  if (folders.size() == 1) html = folders.front() / "report.html";
  if (!out.empty()) html = UserPath(out);
  for (const std::string& note :
       WriteReport(folders, html, PackageFolders(packages))) {
    std::cerr << "report: " << note << '\n';
  }
  std::cout << html.string() << '\n';
  return 0;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("report", [=] { return poise::Main(argc, argv); });
}
