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
  CLI::App app("Says when, what and why in a recorded run.", "explain");
  std::string run;
  bool as_json = false, all = false;
  app.add_option("RUN_DIR", run, "The folder of a run")->required();
  app.add_flag("--json", as_json, "One JSON document, with all the numbers");
  app.add_flag("--all", all, "All sentences, in the order of time");
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
