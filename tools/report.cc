// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "tools/report_page.h"
#include "tools/user_path.h"

int main(int argc, char** argv) {
  CLI::App app(
      "Shows a run, or two on one clock, in one page that opens from disk.",
      "report");
  std::vector<std::string> runs;
  std::string out;
  app.add_option("RUN_DIR", runs, "The folder of a run, or of two to compare")
      ->required()
      ->expected(1, 2);
  app.add_option("--out", out,
                 "The page to write [RUN_DIR/report.html, or of two "
                 "./compare.html]");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "report: " << error.what() << '\n';
    return 2;
  }
  try {
    std::vector<std::filesystem::path> folders;
    for (const std::string& run : runs) {
      folders.push_back(poise::UserPath(run));
    }
    std::filesystem::path html = poise::UserPath("compare.html");
    if (folders.size() == 1) html = folders.front() / "report.html";
    if (!out.empty()) html = poise::UserPath(out);
    poise::WriteReport(folders, html);
    std::cout << html.string() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
