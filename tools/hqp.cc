// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves hierarchies from files: bazel run //tools:hqp -- FILE.json ...

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>

#include "hqp/cascade.h"
#include "hqp/certificate.h"
#include "hqp/solver.h"
#include "robot/text_file.h"
#include "tools/command_line.h"
#include "tools/hqp_file.h"
#include "tools/user_path.h"

namespace poise {
namespace {

constexpr size_t kMostMib = 1024;  // Of a file.

Status Solve(const std::string& method, int max_iterations,
             const HqpProblem& problem, Solution* solution) {
  const int n = problem.hierarchy.num_variables();
  if (method == "fast") {
    Solver solver(n, problem.capacity);
    solver.max_iterations = max_iterations;
    return solver.Solve(problem.hierarchy, solution);
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
  app.add_option("files", files, "Files in the format hqp-1")->required();
  app.add_option("--method", method, "svd or cod: the paper's cascade; or fast")
      ->check(CLI::IsMember({"svd", "cod", "fast"}))
      ->capture_default_str();
  app.add_option("--max-iterations", max_iterations,
                 "Budget of fast; that of a controller's tick is 500")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--json", json, "Print one JSON document");
  ParseCommandLine(argc, argv, &app);
  bool all_optimal = true;
  std::string document;
  for (const std::string& name : files) {
    const std::string text = ReadTextFile(UserPath(name), kMostMib);
    try {
      const HqpProblem problem = ReadHqp(text);
      const int n = problem.hierarchy.num_variables();
      Solution solution(n, problem.capacity);
      const auto start = std::chrono::steady_clock::now();
      all_optimal &=
          Solve(method, max_iterations, problem, &solution) == Status::kOptimal;
      const double microseconds = std::chrono::duration<double, std::micro>(
                                      std::chrono::steady_clock::now() - start)
                                      .count();
      const Certificate certificate =
          Certifier(n, problem.capacity).Certify(problem.hierarchy, solution);
      if (!json) {
        std::cout << name << ": "
                  << DescribeHqpSolution(problem.hierarchy, solution,
                                         certificate, microseconds);
      }
      document += (document.empty() ? "" : ",") +
                  WriteHqpSolution(problem.hierarchy, solution, certificate,
                                   microseconds);
    } catch (const std::exception& error) {
      throw std::invalid_argument(name + ": " + error.what());
    }
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
