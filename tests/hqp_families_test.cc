// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares both solvers with reference solutions of hierarchies in files.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "poise/hqp/certificate.h"
#include "poise/hqp/reference/cascade.h"
#include "poise/hqp/solver.h"
#include "poise/tests/util/shared_data.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

std::string ReadFile(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<std::filesystem::path> Files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Compares costs, residuals and y to 1e-6, the accuracy of the files. The
// certificate of our own solution must be at most 1e-9.
void Compare(const HqpProblem& problem, const nlohmann::json& reference,
             const Solution& solution) {
  const Hierarchy& hierarchy = problem.hierarchy;
  Certifier certifier(hierarchy.num_variables(), problem.capacity);
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_LE(certifier.Certify(hierarchy, solution).worst(), 1e-9);
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    SCOPED_TRACE(level);
    const int equalities = hierarchy.num_equalities(level);
    const int inequalities = hierarchy.num_inequalities(level);
    double size = 1 + hierarchy.b(level).squaredNorm() / 2;
    for (int i = 0; i < inequalities; ++i) {
      for (const double bound :
           {hierarchy.lower(level)[i], hierarchy.upper(level)[i]}) {
        if (!std::isinf(bound)) size += bound * bound / 2;
      }
    }
    const double cost = reference["cost"][level];
    EXPECT_NEAR(solution.levels[level].cost, cost,
                1e-6 * std::max(cost, 1e-6 * size));
    const nlohmann::json& residual = reference["residual"][level];
    for (int i = 0; i < equalities; ++i) {
      EXPECT_NEAR(solution.levels[level].equality_residual[i],
                  residual[i].get<double>(), 1e-6 * std::sqrt(size));
    }
    for (int i = 0; i < inequalities; ++i) {
      EXPECT_NEAR(solution.levels[level].slack[i],
                  residual[equalities + i].get<double>(),
                  1e-6 * std::sqrt(size));
    }
  }
  if (!reference["y_unique"].get<bool>()) return;
  for (int j = 0; j < hierarchy.num_variables(); ++j) {
    EXPECT_NEAR(solution.y[j], reference["y"][j].get<double>(),
                1e-6 * (1 + solution.y.norm()));
  }
}

void CompareAll(const std::filesystem::path& folder) {
  const std::vector<std::filesystem::path> files = Files(folder);
  EXPECT_FALSE(files.empty());
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    const std::string text = ReadFile(file);
    const HqpProblem problem = ReadHqp(text);
    const nlohmann::json reference = nlohmann::json::parse(text)["reference"];
    const Hierarchy& hierarchy = problem.hierarchy;
    const int n = hierarchy.num_variables();
    std::vector<int> nullity;
    Solution solution(n, problem.capacity);
    for (const RowSpaceMethod method :
         {RowSpaceMethod::kSvd, RowSpaceMethod::kCod}) {
      SCOPED_TRACE("cascade");
      ASSERT_EQ(
          Cascade(n, problem.capacity, method).Solve(hierarchy, &solution),
          Status::kOptimal);
      Compare(problem, reference, solution);
    }
    for (const LevelSolution& level : solution.levels) {
      nullity.push_back(level.nullity);
    }
    SCOPED_TRACE("solver");
    Solver solver(n, problem.capacity);
    for (const char* start : {"cold", "warm"}) {
      SCOPED_TRACE(start);
      ASSERT_EQ(solver.Solve(hierarchy, &solution), Status::kOptimal);
      Compare(problem, reference, solution);
      for (int level = 0; level < hierarchy.num_levels(); ++level) {
        EXPECT_EQ(solution.levels[level].nullity, nullity[level]);
      }
    }
    EXPECT_EQ(solution.iterations, 1)
        << "A warm start at the optimal active set needs one factorisation.";
  }
}

TEST(HqpFamilies, AreSolvedByBothSolvers) { CompareAll("tests/hqp"); }

TEST(HqpFamilies, SharedFilesAreSolvedByBothSolvers) {
  const auto folder = SharedData("hqp");
  if (!folder) GTEST_SKIP() << "POISE_SHARED does not name a folder with hqp/";
  CompareAll(*folder);
}

}  // namespace
}  // namespace poise
