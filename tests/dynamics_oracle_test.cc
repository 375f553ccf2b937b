// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Compares the dynamics of real robots and random trees, read from URDF, with
// numbers on which two other libraries agree. All quantities are compared in
// all states.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/shared_data.h"
#include "poise/tools/commands/dynamics/dynamics_file.h"

namespace poise {
namespace {

using nlohmann::json;

// Largest relative difference that the format of the oracle's files allows.
constexpr double kAgreement = 1e-9;

json Read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return json::parse(file);
}

// Returns all numbers of nested arrays, in order.
std::vector<double> Flatten(const json& array) {
  if (!array.is_array()) return {array.get<double>()};
  std::vector<double> numbers;
  for (const json& entry : array) {
    const std::vector<double> more = Flatten(entry);
    numbers.insert(numbers.end(), more.begin(), more.end());
  }
  return numbers;
}

double LargestOf(const std::vector<double>& numbers) {
  double largest = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  return largest;
}

// Returns the largest relative difference, where each entry has its own scale.
// Where the scale is zero, both entries must be equal.
double Disagreement(const json& ours, const json& theirs,
                    const std::function<double(int, int)>& scale_of) {
  double largest = 0;
  EXPECT_EQ(ours.size(), theirs.size());
  for (size_t i = 0; i < theirs.size(); ++i) {
    const std::vector<double> a = Flatten(ours[i]), b = Flatten(theirs[i]);
    EXPECT_EQ(a.size(), b.size());
    for (size_t j = 0; j < b.size(); ++j) {
      const double difference = std::abs(a[j] - b[j]);
      if (difference == 0) continue;
      const double relative =
          difference / scale_of(static_cast<int>(i), static_cast<int>(j));
      if (!(relative <= largest)) largest = relative;
    }
  }
  return largest;
}

double BlockDisagreement(const json& ours, const json& theirs) {
  const double scale = LargestOf(Flatten(theirs));
  // Where the reference is zero, our value may be a rounding error. It is then
  // compared with 1e-3, in SI units.
  return Disagreement(ours, theirs,
                      [scale](int, int) { return scale > 0 ? scale : 1e-3; });
}

// Returns the largest relative difference in one state.
double StateDisagreement(const json& ours, const json& theirs) {
  double largest = 0;
  for (const char* key : {"bias_h", "gravity_g", "tau_inverse_dynamics", "com",
                          "com_velocity", "h_G", "AGdot_nu"}) {
    SCOPED_TRACE(key);
    const double block = BlockDisagreement(ours[key], theirs[key]);
    EXPECT_LE(block, kAgreement);
    largest = std::max(largest, block);
  }
  const double M = Disagreement(ours["M"], theirs["M"], [&](int i, int j) {
    return std::sqrt(theirs["M"][i][i].get<double>() *
                     theirs["M"][j][j].get<double>());
  });
  EXPECT_LE(M, kAgreement) << "M";
  std::vector<double> columns(theirs["M"].size(), 0);
  for (const json& row : theirs["A_G"]) {
    for (size_t j = 0; j < row.size(); ++j) {
      columns[j] = std::max(columns[j], std::abs(row[j].get<double>()));
    }
  }
  const double A_G = Disagreement(ours["A_G"], theirs["A_G"],
                                  [&](int, int j) { return columns[j]; });
  EXPECT_LE(A_G, kAgreement) << "A_G";
  for (const auto& frame : theirs["frames"].items()) {
    for (const char* key : {"p", "R", "J", "Jdot_nu"}) {
      SCOPED_TRACE(frame.key() + " " + key);
      const double block = BlockDisagreement(ours["frames"][frame.key()][key],
                                             frame.value()[key]);
      EXPECT_LE(block, kAgreement);
      largest = std::max(largest, block);
    }
  }
  return std::max({largest, M, A_G});
}

// Returns the largest relative difference over all states of a file.
double FileDisagreement(const std::filesystem::path& oracle,
                        const std::filesystem::path& urdf) {
  const json theirs = Read(oracle);
  const json ours = ComputeDynamics(LoadUrdf(urdf).tree, theirs, {});
  EXPECT_EQ(ours["nv"], theirs["nv"]);
  EXPECT_EQ(ours["root_link"], theirs["root_link"]);
  const double mass = theirs["total_mass"];
  EXPECT_NEAR(ours["total_mass"].get<double>(), mass, kAgreement * mass);
  EXPECT_GE(theirs["states"].size(), 1);
  double largest = 0;
  for (size_t i = 0; i < theirs["states"].size(); ++i) {
    SCOPED_TRACE("state " + std::to_string(i));
    largest = std::max(
        largest, StateDisagreement(ours["states"][i], theirs["states"][i]));
  }
  return largest;
}

TEST(DynamicsOracle, AgreesOnTheTreeOfTheRepository) {
  EXPECT_LE(FileDisagreement("tests/dynamics/tree01.json",
                             "tests/dynamics/tree01.urdf"),
            kAgreement);
}

TEST(DynamicsOracle, DetectsWrongNumber) {
  json theirs = Read("tests/dynamics/tree01.json");
  const json ours =
      ComputeDynamics(LoadUrdf("tests/dynamics/tree01.urdf").tree, theirs, {});
  const json& N = theirs["states"][1]["bias_h"];
  json wrong = N;
  wrong[7] = wrong[7].get<double>() + 2e-9 * LargestOf(Flatten(N));
  EXPECT_GT(BlockDisagreement(ours["states"][1]["bias_h"], wrong), kAgreement);
  EXPECT_LE(BlockDisagreement(ours["states"][1]["bias_h"], N), kAgreement);
}

TEST(DynamicsOracle, AgreesOnAllRobots) {
  const auto oracle = SharedData("oracle"), robots = SharedData("robots");
  if (!oracle || !robots) GTEST_SKIP() << "no oracle data in POISE_SHARED";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*oracle)) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    ++files;
    const double largest =
        FileDisagreement(entry.path(), *robots / (name + ".urdf"));
    EXPECT_LE(largest, kAgreement);
    std::cout << name << " agrees to " << largest << "\n";
  }
  EXPECT_GE(files, 1);
}

}  // namespace
}  // namespace poise
