// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves hierarchies from files: bazel run //tools:hqp -- FILE.json ...
// Several are the ticks of one fast solver, in their order: each starts from what
// was active in the one before, as in a controller.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/robot/text_file.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/hqp/hqp_file.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

constexpr size_t kMostMib = 1024;  // Of a file.

// Reads a file, or says which one cannot be read.
HqpProblem Read(const std::string& name) {
  const std::string text = ReadTextFile(UserPath(name), kMostMib);
  try {
    HqpProblem problem = ReadHqp(text);
    for (const std::string& key : problem.ignored) {
      std::cerr << "hqp: " << name << ": " << key
                << " is not a key of hqp-1: ignored\n";
    }
    return problem;
  } catch (const std::exception& error) {
    throw std::invalid_argument(name + ": " + error.what());
  }
}

// Rows enough for all of them.
std::vector<LevelCapacity> Room(const std::vector<HqpProblem>& problems) {
  std::vector<LevelCapacity> room;
  for (const HqpProblem& problem : problems) {
    room.resize(std::max(room.size(), problem.capacity.size()));
    for (size_t level = 0; level < problem.capacity.size(); ++level) {
      const LevelCapacity& rows = problem.capacity[level];
      LevelCapacity& to = room[level];
      to.equalities = std::max(to.equalities, rows.equalities);
      to.inequalities = std::max(to.inequalities, rows.inequalities);
    }
  }
  return room;
}

// `living`: the fast solver of the problem before, if any; it is the one of this
// problem from now on.
Status Solve(const std::string& method, int max_iterations,
             const std::vector<LevelCapacity>& room, const HqpProblem& problem,
             std::unique_ptr<Solver>* living, Solution* solution) {
  const int n = problem.hierarchy.num_variables();
  if (method == "fast") {
    if (*living == nullptr) *living = std::make_unique<Solver>(n, room);
    (*living)->max_iterations = max_iterations;
    return (*living)->Solve(problem.hierarchy, solution);
  }
  return Cascade(n, problem.capacity,
                 method == "svd" ? RowSpaceMethod::kSvd : RowSpaceMethod::kCod)
      .Solve(problem.hierarchy, solution);
}

int Main(int argc, char** argv) {
  CLI::App app("Solves hierarchies of rows (format hqp-1).", "hqp");
  std::vector<std::string> files;
  std::string method = "fast";
  int max_iterations = 10000;  // There is no tick to be in time for.
  bool json = false;
  bool cold = false;
  app.add_option(
         "files", files,
         "Files in the format hqp-1; several are ticks of one fast "
         "solver, in their order, as long as they have as many variables")
      ->required();
  app.add_option("--method", method, "svd or cod: the paper's cascade; or fast")
      ->check(CLI::IsMember({"svd", "cod", "fast"}))
      ->capture_default_str();
  app.add_option("--max-iterations", max_iterations,
                 "Budget of fast; that of a controller's tick is 500")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--cold", cold, "Solve each file with a solver of its own");
  app.add_flag("--json", json,
               "Print one JSON document, an array if there are several files");
  ParseCommandLine(argc, argv, &app);
  bool all_optimal = true;
  std::string document;
  std::vector<HqpProblem> problems;
  for (const std::string& name : files) problems.push_back(Read(name));
  const std::vector<LevelCapacity> room = Room(problems);
  std::unique_ptr<Solver> living;
  int living_variables = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    const HqpProblem& problem = problems[i];
    const int n = problem.hierarchy.num_variables();
    if (cold || n != living_variables) living.reset();
    living_variables = n;
    Solution solution(n, problem.capacity);
    const auto start = std::chrono::steady_clock::now();
    all_optimal &= Solve(method, max_iterations, room, problem, &living,
                         &solution) == Status::kOptimal;
    const double microseconds = std::chrono::duration<double, std::micro>(
                                    std::chrono::steady_clock::now() - start)
                                    .count();
    const Certificate& certificate = solution.certificate;
    if (!json) {
      std::cout << files[i] << ": "
                << DescribeHqpSolution(problem.hierarchy, solution, certificate,
                                       microseconds);
    }
    document += (document.empty() ? "" : ",") +
                WriteHqpSolution(problem.hierarchy, solution, certificate,
                                 microseconds);
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
