// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <iostream>
#include <string>

#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/explain/explanation.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

int Main(int argc, char** argv) {
  CLI::App app("Explains a recorded run: what happened, when, and why.",
               "explain");
  std::string run;
  bool as_json = false, all = false;
  app.add_option("RUN_DIR", run, "The folder that push wrote")->required();
  app.add_flag("--json", as_json, "Print one JSON document with all numbers");
  app.add_flag("--all", all,
               "Print all sentences in order of time, not the summary");
  ParseCommandLine(argc, argv, &app);
  const nlohmann::json explanation = Explain(UserPath(run));
  if (as_json) {
    std::cout << explanation.dump(2) << '\n';
  } else {
    for (const auto& sentence : explanation[all ? "sentences" : "story"]) {
      std::cout << sentence.get<std::string>() << '\n';
    }
  }
  return 0;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("explain", [=] { return poise::Main(argc, argv); });
}
