// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves hierarchies from files: bazel run //tools:hqp -- FILE.json ...
// The fast solver treats several files as successive ticks of a controller:
// each solve starts from the working set of the previous file.

#include <CLI/CLI.hpp>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/hqp/certificate.h"
#include "poise/hqp/solution.h"
#include "poise/robot/finding.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/hqp/hqp_file.h"
#include "poise/tools/commands/hqp/solve_files.h"

namespace poise {
namespace {

// Refuses values that CLI11 accepts, such as NaN, and a budget that has no
// effect. Warns of an iteration limit without effect; each solve of the cascade
// is cold.
void CheckMethod(const CLI::App& app, const HqpMethod& method) {
  constexpr double kMostUs = 1e6;
  if (!(method.budget_us >= 0 && method.budget_us <= kMostUs)) {
    throw std::invalid_argument("--budget-us is " +
                                PrintNumber(method.budget_us) +
                                ", must be 0 to 1e+06 us");
  }
  if (method.name == "fast") return;
  const std::string why =
      " has an effect with --method fast only, but --method is " + method.name;
  if (app.count("--budget-us") > 0) {
    throw std::invalid_argument("--budget-us" + why);
  }
  if (app.count("--max-iterations") > 0) {
    std::cerr << "hqp: --max-iterations" << why << ", ignored\n";
  }
}

int Main(int argc, char** argv) {
  CLI::App app("Solves hierarchical quadratic programs (format hqp-1).", "hqp");
  std::vector<std::string> files;
  HqpMethod method;
  bool json = false;
  app.add_option(
         "files", files,
         "Files in the format hqp-1. Each fast solve starts from the working "
         "set of the previous file, if both have as many variables")
      ->required();
  app.add_option("--method", method.name,
                 "svd or cod: the cascade of the paper; fast: the active-set "
                 "solver of the controller")
      ->check(CLI::IsMember({"svd", "cod", "fast"}))
      ->capture_default_str();
  app.add_option("--max-iterations", method.max_iterations,
                 "Maximum number of iterations of fast per file; a controller "
                 "allows 500 per tick")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  app.add_option("--budget-us", method.budget_us,
                 "Limit of the predicted time of each solve by fast, us, as of "
                 "push --budget-us; 0: no limit")
      ->capture_default_str();
  app.add_flag("--cold", method.cold,
               "Solve each file with a new solver, from an empty working set");
  app.add_flag("--json", json,
               "Print one JSON document, an array if there are several files");
  ParseCommandLine(argc, argv, &app);
  CheckMethod(app, method);
  bool all_optimal = true;
  std::string document;
  std::vector<HqpProblem> problems;
  for (const std::string& name : files) {
    problems.push_back(LoadHqp(name));
    for (const std::string& key : problems.back().ignored) {
      std::cerr << "hqp: " << name << ": " << key
                << " is not a key of hqp-1, ignored\n";
    }
  }
  HqpSequence sequence(method, problems);
  for (size_t i = 0; i < files.size(); ++i) {
    const HqpProblem& problem = problems[i];
    Solution solution(problem.hierarchy.num_variables(), problem.capacity);
    SolveTimes times = {0, {}};
    all_optimal &=
        sequence.Solve(problem, &solution, &times) == Status::kOptimal;
    const Certificate& certificate = solution.certificate;
    if (json) {
      document +=
          (document.empty() ? "" : ",") +
          WriteHqpSolution(problem.hierarchy, solution, certificate, times);
      continue;
    }
    std::cout << files[i] << ": "
              << DescribeHqpSolution(problem.hierarchy, solution, certificate,
                                     times)
              << std::flush;
  }
  if (json) {
    std::cout << (files.size() == 1 ? document : "[" + document + "]") << "\n";
  }
  return all_optimal ? 0 : 1;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("hqp", [=] { return poise::Main(argc, argv); });
}
