// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/solution.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <new>

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void ExpectAsConstructed(const Solution& solution, int num_variables) {
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_EQ(solution.failed_level, -1);
  EXPECT_EQ(solution.iterations, 0);
  EXPECT_EQ(solution.y.size(), num_variables);
  EXPECT_TRUE(solution.y.isZero(0));
  EXPECT_EQ(solution.certificate.worst(), 0);
  for (const LevelSolution& level : solution.levels) {
    EXPECT_EQ(level.cost, 0);
    EXPECT_EQ(level.gap, kInfinity);
    EXPECT_TRUE(level.equality_residual.isZero(0));
    EXPECT_TRUE(level.slack.isZero(0));
    for (const Side side : level.active) EXPECT_EQ(side, Side::kNone);
    EXPECT_EQ(level.nullity, num_variables);
    EXPECT_EQ(level.traded_level, -1);
    for (const LevelMultipliers& multipliers : level.multipliers) {
      EXPECT_TRUE(multipliers.equality.isZero(0));
      EXPECT_TRUE(multipliers.inequality.isZero(0));
    }
  }
}

void FillWithSevens(Solution* solution) {
  solution->status = Status::kBadInput;
  solution->failed_level = 1;
  solution->iterations = 9;
  solution->y.setConstant(7);
  solution->certificate.priority = 7;
  for (LevelSolution& level : solution->levels) {
    level.cost = 7;
    level.gap = 7;
    level.equality_residual.setConstant(7);
    level.slack.setConstant(7);
    level.active.assign(level.active.size(), Side::kUpper);
    level.nullity = level.traded_level = 7;
    for (LevelMultipliers& multipliers : level.multipliers) {
      multipliers.equality.setConstant(7);
      multipliers.inequality.setConstant(7);
    }
  }
}

TEST(Solution, ResetRestoresTheInitialState) {
  Solution solution(3, {{1, 2}, {3, 4}});
  ExpectAsConstructed(solution, 3);
  ASSERT_EQ(solution.levels[1].multipliers.size(), 1u);
  EXPECT_EQ(solution.levels[1].multipliers[0].equality.size(), 1);
  EXPECT_EQ(solution.levels[1].multipliers[0].inequality.size(), 2);
  EXPECT_EQ(solution.levels[1].equality_residual.size(), 3);
  EXPECT_EQ(solution.levels[1].slack.size(), 4);
  EXPECT_EQ(solution.levels[1].active.size(), 4u);

  FillWithSevens(&solution);
  solution.Reset();
  ExpectAsConstructed(solution, 3);
}

TEST(Solution, ResetForAHierarchyRestoresWhatItUses) {
  const std::vector<LevelCapacity> capacity = {{1, 2}, {3, 4}};
  Solution solution(3, capacity);
  Hierarchy hierarchy(3, capacity);
  const auto use = [&](int first, int second) {
    hierarchy.Clear(2);
    (void)hierarchy.AddEqualities(0, first);
    (void)hierarchy.AddInequalities(0, 2 * first);
    (void)hierarchy.AddEqualities(1, second);
    (void)hierarchy.AddInequalities(1, second + 1);
  };
  use(1, 3);
  FillWithSevens(&solution);
  solution.Reset(hierarchy);
  ExpectAsConstructed(solution, 3);

  use(0, 2);
  FillWithSevens(&solution);
  solution.Reset(hierarchy);
  EXPECT_EQ(solution.levels[1].slack, Eigen::Vector4d(0, 0, 0, 7));
  EXPECT_EQ(solution.levels[1].equality_residual, Eigen::Vector3d(0, 0, 7));
  EXPECT_EQ(solution.levels[1].active[2], Side::kNone);
  EXPECT_EQ(solution.levels[1].active[3], Side::kUpper);
  EXPECT_TRUE(solution.levels[1].multipliers[0].equality.isConstant(7));
}

TEST(Solution, InitialisesAllMembers) {
  alignas(Solution) unsigned char memory[sizeof(Solution)];
  std::memset(memory, 7, sizeof(memory));
  Solution* solution = new (memory) Solution(2, {{0, 0}, {0, 0}});
  ExpectAsConstructed(*solution, 2);
  solution->~Solution();
}

TEST(CertificateNumbers, TheWorstIsInfiniteIfOneIsNaN) {
  for (double Certificate::*number :
       {&Certificate::stationarity, &Certificate::feasibility,
        &Certificate::complementarity, &Certificate::priority}) {
    Certificate certificate;
    EXPECT_EQ(certificate.worst(), 0);
    certificate.*number = 1e-3;
    EXPECT_EQ(certificate.worst(), 1e-3);
    certificate.*number = kNan;
    EXPECT_EQ(certificate.worst(), kInfinity);
  }
}

TEST(EvaluateLevel, AgreesWithNumbersByHand) {
  Hierarchy hierarchy(2, {{2, 3}});
  EqualityBlock equalities = hierarchy.AddEqualities(0, 2);
  equalities.B << 1, 2, 3, 4;
  equalities.b << -4, 1;
  equalities.weight << 1, 10;
  InequalityBlock inequalities = hierarchy.AddInequalities(0, 3);
  inequalities.C << 1, 0, 0, 1, 1, 1;
  inequalities.lower << 3, -kInfinity, 0;
  inequalities.upper << kInfinity, 1.5, 9;
  Solution solution(2, {{2, 3}});
  solution.y << 1, 2;
  const LevelSolution& level = solution.levels[0];
  solution.levels[0].cost = 7;  // Must be overwritten.
  EvaluateLevel(hierarchy, 0, &solution);
  EXPECT_EQ(level.equality_residual, Eigen::Vector2d(1, 12));
  EXPECT_EQ(level.slack, Eigen::Vector3d(2, 0.5, 0));
  EXPECT_EQ(level.cost, (1 + 10 * 144) / 2.0 + (4 + 0.25) / 2);
}

class CheckInputTest : public testing::Test {
 protected:
  CheckInputTest()
      : equalities_(hierarchy_.AddEqualities(1, 1)),
        inequalities_(hierarchy_.AddInequalities(1, 1)) {
    inequalities_.lower << -1;
    inequalities_.upper << 1;
  }

  // Returns the status of the input with `number` set to `value`, and restores
  // the number.
  Status With(double* number, double value) {
    const double good = *number;
    *number = value;
    const Status status = CheckInput(hierarchy_, &failed_level_);
    EXPECT_EQ(failed_level_, status == Status::kOptimal ? -1 : 1);
    *number = good;
    return status;
  }

  Hierarchy hierarchy_{1, {{1, 1}, {1, 1}}};
  EqualityBlock equalities_;
  InequalityBlock inequalities_;
  int failed_level_ = 7;
};

TEST_F(CheckInputTest, FindsNumbersThatAreNotFinite) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    SCOPED_TRACE(bad);
    EXPECT_EQ(With(equalities_.B.data(), bad), Status::kNotFinite);
    EXPECT_EQ(With(equalities_.b.data(), bad), Status::kNotFinite);
    EXPECT_EQ(With(equalities_.weight.data(), bad), Status::kNotFinite);
    EXPECT_EQ(With(inequalities_.C.data(), bad), Status::kNotFinite);
  }
  EXPECT_EQ(With(inequalities_.lower.data(), kNan), Status::kNotFinite);
  EXPECT_EQ(With(inequalities_.upper.data(), kNan), Status::kNotFinite);
  EXPECT_EQ(With(inequalities_.lower.data(), kInfinity), Status::kNotFinite);
  EXPECT_EQ(With(inequalities_.upper.data(), -kInfinity), Status::kNotFinite);
}

TEST_F(CheckInputTest, ReportsTheFirstLevelWithAnError) {
  hierarchy_.AddEqualities(0, 1).weight << -1;
  EXPECT_EQ(CheckInput(hierarchy_, &failed_level_), Status::kBadInput);
  EXPECT_EQ(failed_level_, 0);
  equalities_.b << kNan;
  EXPECT_EQ(CheckInput(hierarchy_, &failed_level_), Status::kBadInput);
  EXPECT_EQ(failed_level_, 0);
}

// A cost is the square of a row. Where that overflows, nothing can be
// certified.
TEST(CheckInput, AcceptsNumbersWhoseSquaresAreFinite) {
  for (const bool is_equality : {true, false}) {
    for (const double entry : {1e153, 1e154, 1e308}) {
      Hierarchy hierarchy(2, {{1, 1}});
      if (is_equality) {
        hierarchy.AddEqualities(0, 1).B.setConstant(entry);
      } else {
        hierarchy.AddInequalities(0, 1).C.setConstant(entry);
      }
      int failed_level = 7;
      const bool is_valid = entry == 1e153;  // (2e153)^2 = 4e306.
      EXPECT_EQ(CheckInput(hierarchy, &failed_level),
                is_valid ? Status::kOptimal : Status::kNotFinite);
      EXPECT_EQ(failed_level, is_valid ? -1 : 0);
    }
  }
}

TEST_F(CheckInputTest, RejectsInvalidBoundsAndWeights) {
  EXPECT_EQ(With(inequalities_.lower.data(), 1.5), Status::kBadInput);
  EXPECT_EQ(With(equalities_.weight.data(), -1), Status::kBadInput);
}

TEST_F(CheckInputTest, AcceptsEqualBoundsAndZeroWeights) {
  EXPECT_EQ(With(inequalities_.lower.data(), 1), Status::kOptimal);
  EXPECT_EQ(With(inequalities_.lower.data(), -kInfinity), Status::kOptimal);
  EXPECT_EQ(With(inequalities_.upper.data(), kInfinity), Status::kOptimal);
  EXPECT_EQ(With(equalities_.weight.data(), 0), Status::kOptimal);
}

}  // namespace
}  // namespace poise
