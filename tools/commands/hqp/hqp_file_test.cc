// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/hqp/hqp_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "poise/hqp/solver.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr char kFile[] = R"({
  "format": "hqp-1", "name": "two", "variables": 2,
  "levels": [
    {"A": [[1, 0]], "a": [-1], "C": [[0, 1], [1, 1]],
     "lower": [2, null], "upper": [null, 10]},
    {"B": [[1, 1]], "b": [-4], "weight": [0.25]},
    {"name": "target", "B": [[1, 0], [0, 1]], "b": [-5, 0]}],
  "y_lower": [null, -7], "y_upper": [8, null], "y_bounds_level": 2})";

TEST(ReadHqp, ReadsAllBlocks) {
  const HqpProblem problem = ReadHqp(kFile);
  const Hierarchy& hierarchy = problem.hierarchy;
  EXPECT_EQ(hierarchy.num_variables(), 2);
  ASSERT_EQ(hierarchy.num_levels(), 3);
  // A y + a <= 0 comes first, then the rows of C.
  ASSERT_EQ(hierarchy.num_inequalities(0), 3);
  EXPECT_EQ(hierarchy.C(0),
            (Eigen::MatrixXd(3, 2) << 1, 0, 0, 1, 1, 1).finished());
  EXPECT_EQ(hierarchy.lower(0)[0], -INFINITY);
  EXPECT_EQ(hierarchy.upper(0)[0], 1);
  EXPECT_EQ(hierarchy.lower(0)[1], 2);
  EXPECT_EQ(hierarchy.upper(0)[1], INFINITY);
  EXPECT_EQ(hierarchy.lower(0)[2], -INFINITY);
  EXPECT_EQ(hierarchy.upper(0)[2], 10);
  EXPECT_EQ(hierarchy.B(1), Eigen::RowVector2d(1, 1));
  EXPECT_EQ(hierarchy.b(1)[0], -4);
  EXPECT_EQ(hierarchy.weight(1)[0], 0.25);
  EXPECT_EQ(hierarchy.weight(2), Eigen::Vector2d(1, 1));
  // The bounds on y come last.
  ASSERT_EQ(hierarchy.num_inequalities(2), 2);
  EXPECT_EQ(hierarchy.C(2), Eigen::Matrix2d::Identity());
  EXPECT_EQ(hierarchy.lower(2), Eigen::Vector2d(-INFINITY, -7));
  EXPECT_EQ(hierarchy.upper(2), Eigen::Vector2d(8, INFINITY));
}

TEST(ReadHqp, ListsIgnoredKeys) {
  const HqpProblem problem = ReadHqp(R"({
      "format": "hqp-1", "name": "a", "variables": 1, "y_uper": [1],
      "levels": [{"name": "b", "B": [[1]], "b": [1]},
                 {"C": [[1]], "lowr": [1], "inequality_names": ["c"]}]})");
  EXPECT_EQ(problem.ignored,
            (std::vector<std::string>{"y_uper", "levels[1].lowr"}));
}

TEST(WriteHqp, ReadHqpRestoresTheSameNumbers) {
  HqpProblem problem = ReadHqp(kFile);
  const std::string once = WriteHqp(problem.hierarchy);
  const HqpProblem again = ReadHqp(once);
  EXPECT_EQ(WriteHqp(again.hierarchy), once);
  for (int level = 0; level < 3; ++level) {
    EXPECT_EQ(again.hierarchy.B(level), problem.hierarchy.B(level));
    EXPECT_EQ(again.hierarchy.b(level), problem.hierarchy.b(level));
    EXPECT_EQ(again.hierarchy.weight(level), problem.hierarchy.weight(level));
    EXPECT_EQ(again.hierarchy.C(level), problem.hierarchy.C(level));
    EXPECT_EQ(again.hierarchy.lower(level), problem.hierarchy.lower(level));
    EXPECT_EQ(again.hierarchy.upper(level), problem.hierarchy.upper(level));
  }
}

TEST(WriteHqpSolution, HasAllKeysOfTheFormat) {
  const HqpProblem problem = ReadHqp(kFile);
  Solver solver(2, problem.capacity);
  Solution solution(2, problem.capacity);
  ASSERT_EQ(solver.Solve(problem.hierarchy, &solution), Status::kOptimal);
  Certificate certificate;
  certificate.stationarity = 1;
  certificate.feasibility = 2;
  certificate.complementarity = 3;
  certificate.priority = 4;
  const json out = json::parse(
      WriteHqpSolution(problem.hierarchy, solution, certificate, {5, 4}));
  EXPECT_EQ(out["status"], "optimal");
  EXPECT_NEAR(out["y"][0], 1, 1e-14);  // Rounding of a few operations.
  EXPECT_NEAR(out["y"][1], 3, 1e-14);
  EXPECT_NEAR(out["levels"][2]["cost"], 12.5, 1e-13);
  // Level 2 is [1, 3] - [2, 8] with multipliers up to 7; an error of y of 1e-14
  // changes its cost by far less than 1e-10.
  EXPECT_GE(out["levels"][2]["gap"], 0);
  EXPECT_LE(out["levels"][2]["gap"], 1e-10);
  EXPECT_EQ(out["levels"][2]["equality_residual"].size(), 2);
  EXPECT_EQ(out["levels"][0]["slack"].size(), 3);
  EXPECT_EQ(out["levels"][0]["active"], json({1, 0, 0}));
  EXPECT_EQ(out["levels"][1]["nullity"], 1);
  EXPECT_EQ(out["levels"][2]["multipliers"][1]["level"], 1);
  EXPECT_NEAR(out["levels"][2]["multipliers"][1]["equality"][0], -3, 1e-13);
  EXPECT_NEAR(out["levels"][2]["multipliers"][0]["inequality"][0], 7, 1e-13);
  EXPECT_EQ(out["certificate"]["stationarity"], 1);
  EXPECT_EQ(out["certificate"]["feasibility"], 2);
  EXPECT_EQ(out["certificate"]["complementarity"], 3);
  EXPECT_EQ(out["certificate"]["priority"], 4);
  EXPECT_EQ(out["iterations"], solution.iterations);
  EXPECT_EQ(out["microseconds"], 5);
  EXPECT_EQ(out["modelled_us"], 4);
  EXPECT_TRUE(out["failed_level"].is_null());
  EXPECT_EQ(out["certified_levels"], 3);
}

// Describes a solution whose solve failed at a level.
class UnfinishedTest : public testing::Test {
 protected:
  UnfinishedTest() : problem_(ReadHqp(kFile)), solution_(2, problem_.capacity) {
    certificate_.stationarity = 1e-14;
  }
  json Written(Status status, int failed_level) {
    solution_.status = status;
    solution_.failed_level = failed_level;
    return json::parse(
        WriteHqpSolution(problem_.hierarchy, solution_, certificate_, {5, 4}));
  }
  std::string Said() const {
    return DescribeHqpSolution(problem_.hierarchy, solution_, certificate_,
                               {5, 4});
  }

  HqpProblem problem_;
  Solution solution_;
  Certificate certificate_;
};

TEST_F(UnfinishedTest, SaysWhichLevelsAreCertified) {
  const json out = Written(Status::kIterationLimit, 2);
  EXPECT_EQ(out["failed_level"], 2);
  EXPECT_EQ(out["certified_levels"], 2);
  EXPECT_EQ(out["certificate"]["stationarity"], 1e-14);
  EXPECT_EQ(out["certificate"]["priority"], 0);
  const std::string said = Said();
  EXPECT_NE(said.find("certificate 1e-14 of the first 2 of 3 levels\n"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("level 1: cost 0, gap inf, nullity 2\n"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("level 2: cost 0, gap inf, nullity 2, NOT certified\n"),
            std::string::npos)
      << said;
}

TEST_F(UnfinishedTest, WritesNoCertificateIfNoLevelIsCertified) {
  for (const json& out :
       {Written(Status::kIterationLimit, 0), Written(Status::kNotFinite, 1)}) {
    EXPECT_EQ(out["certified_levels"], 0);
    for (const json& number : out["certificate"]) {
      EXPECT_TRUE(number.is_null());
    }
    EXPECT_NE(Said().find("us predicted, no certificate\n"), std::string::npos);
  }
  // The Cascade has an additional last level, the norm of y.
  EXPECT_EQ(Written(Status::kIterationLimit, 3)["certified_levels"], 3);
}

TEST(Name, GivesStatusWordsOfTheFormat) {
  EXPECT_EQ(Name(Status::kOptimal), "optimal");
  EXPECT_EQ(Name(Status::kIterationLimit), "iteration_limit");
  EXPECT_EQ(Name(Status::kNotFinite), "not_finite");
  EXPECT_EQ(Name(Status::kBadInput), "bad_input");
}

// Returns the message with which ReadHqp() rejects a file.
std::string Refusal(const std::string& text) {
  try {
    ReadHqp(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ReadHqp, RejectsInOneLine) {
  const std::string head = R"({"format": "hqp-1", "variables": 2, "levels": )";
  EXPECT_NE(Refusal("{").find("not JSON"), std::string::npos);
  EXPECT_EQ(Refusal("{").find('\n'), std::string::npos);
  for (const std::string root : {"[1,2]", "null", "\"x\""}) {
    EXPECT_EQ(Refusal(root), "is " + root +
                                 ", must be an object with the keys format, "
                                 "variables and levels");
  }
  EXPECT_EQ(Refusal("{}"), "format: is missing, must be \"hqp-1\"");
  EXPECT_EQ(Refusal(R"({"format": "hqp-2"})"),
            R"(format: is "hqp-2", must be "hqp-1")");
  EXPECT_EQ(Refusal(R"({"format": "hqp-1"})"), "variables: is missing");
  EXPECT_EQ(Refusal(R"({"format": "hqp-1", "variables": 0})"),
            "variables: is 0, must be a whole number from 1 to 2000");
  EXPECT_EQ(Refusal(R"({"format": "hqp-1", "variables": 1})"),
            "levels: is missing, must have 1 to 1000 entries");
  EXPECT_EQ(Refusal(head + "[]}"),
            "levels: has 0 entries, must have 1 to 1000");
  EXPECT_EQ(Refusal(head + "3}"), "file.levels: is 3, must be an array");
  EXPECT_EQ(Refusal(head + "[3]}"), "levels[0]: is 3, must be an object");
  EXPECT_EQ(Refusal(head + R"([{"B": [[1, 2]]}]})"),
            "levels[0].b: is missing, must have 1 entry, as many as B has "
            "rows");
  EXPECT_EQ(Refusal(head + R"([{"b": [1, 2]}]})"),
            "levels[0].B: is missing, but b has 2 entries");
  EXPECT_EQ(Refusal(head + R"([{"weight": [1]}]})"),
            "levels[0].B: is missing, but weight has 1 entry");
  EXPECT_EQ(Refusal(head + R"([{"upper": [1]}]})"),
            "levels[0].C: is missing, but upper has 1 entry");
  EXPECT_EQ(Refusal(head + R"([{"B": [[1, 2]], "b": []}]})"),
            "levels[0].b: has 0 entries, must have 1");
  EXPECT_EQ(Refusal(head + R"([{"B": [[1]], "b": [1]}]})"),
            "levels[0].B[0]: has 1 entry, must have 2");
  EXPECT_EQ(Refusal(head + R"([{"B": [[1, "x"]], "b": [1]}]})"),
            R"(levels[0].B[0][1]: is "x", must be a number)");
  // A long value is cut.
  EXPECT_EQ(
      Refusal(head + "[\"" + std::string(60, 'x') + "\"]}"),
      "levels[0]: is \"" + std::string(39, 'x') + "..., must be an object");
  EXPECT_EQ(Refusal(head + R"([{"A": [[1, 2]], "a": [null]}]})"),
            "levels[0].a[0]: is null, must be a number");
  EXPECT_EQ(Refusal(head + R"([{"C": [[1, 2]], "lower": [1, 2]}]})"),
            "levels[0].lower: has 2 entries, must have 1");
  EXPECT_EQ(Refusal(head + R"([{"B": [], "b": [], "weight": [1]}]})"),
            "levels[0].weight: has 1 entry, must have 0");
  EXPECT_EQ(Refusal(head + R"([{}], "y_lower": [1]})"),
            "y_lower: has 1 entry, must have 2");
  EXPECT_EQ(Refusal(head + R"([{}], "y_lower": [1, 1], "y_bounds_level": 1})"),
            "y_bounds_level: is 1, must be a whole number from 0 to 0");
  EXPECT_EQ(Refusal(head + R"([{}], "y_bounds_level": 1})"),
            "y_bounds_level: is 1, must be a whole number from 0 to 0");
}

TEST(ReadHqp, RejectsCrossedBoundsAndNegativeWeights) {
  const std::string head =
      R"({"format": "hqp-1", "variables": 2, "levels": [{}, )";
  EXPECT_EQ(Refusal(head + R"({"C": [[1, 0], [0, 1]], "lower": [1, 2.5],
                               "upper": [1, -1]}]})"),
            "levels[1].lower[1]: is 2.5, must not be above upper[1], -1");
  EXPECT_EQ(Refusal(head + R"({"B": [[1, 0], [0, 1]], "b": [1, 1],
                               "weight": [0, -0.5]}]})"),
            "levels[1].weight[1]: is -0.5, must not be negative");
  EXPECT_EQ(Refusal(head + R"({}], "y_lower": [-1, 3], "y_upper": [null, 2]})"),
            "y_lower[1]: is 3, must not be above y_upper[1], 2");
}

}  // namespace
}  // namespace poise
