// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "tools/explanation.h"
#include "tools/user_path.h"

int main(int argc, char** argv) {
  CLI::App app("Says when, what and why in a recorded run.", "explain");
  std::string run;
  bool as_json = false;
  app.add_option("RUN_DIR", run, "The folder of a run")->required();
  app.add_flag("--json", as_json, "One JSON document, with all the numbers");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "explain: " << error.what() << '\n';
    return 2;
  }
  try {
    const nlohmann::json explanation = poise::Explain(poise::UserPath(run));
    if (as_json) {
      std::cout << explanation.dump(2) << '\n';
    } else {
      for (const auto& sentence : explanation["sentences"]) {
        std::cout << sentence.get<std::string>() << '\n';
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "explain: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
