// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/path_between.h"

#include <gtest/gtest.h>

#include <limits>

#include "poise/hqp/fast/budget.h"
#include "poise/tests/util/count_malloc.h"

namespace poise {

PathBetween::PathBetween(int num_variables,
                         const std::vector<LevelCapacity>& capacity)
    : n_(num_variables),
      problem_(num_variables, capacity),
      search_(num_variables, capacity),
      path_(num_variables, capacity),
      answer_(num_variables),
      side_(NoSides(capacity)) {}

void PathBetween::Begin(const Hierarchy& hierarchy) {
  Budget budget({kEnough}, &no_clock_);
  Read(hierarchy);
  search_.ForgetPath();
  FitToBounds(hierarchy, &side_);
  ASSERT_TRUE(
      search_.AllAtOnce(hierarchy, kEnough, &budget, &problem_, &side_));
  *path_.mutable_y() = search_.y();
  path_.Remember(problem_, side_);
}

void PathBetween::Start(const Hierarchy& hierarchy) {
  Read(hierarchy);
  problem_.Plan(hierarchy, hierarchy.num_levels());
  problem_.Start(hierarchy, side_, path_.mutable_y());
}

bool PathBetween::Follow(const Hierarchy& hierarchy, int limit) {
  Start(hierarchy);
  return FollowFromHere(hierarchy, limit);
}

bool PathBetween::FollowFromHere(const Hierarchy& hierarchy, int limit,
                                 double modelled_seconds) {
  Budget budget({limit, modelled_seconds}, &no_clock_);
  problem_.SolveDiagonal();
  const CountMalloc count;
  const bool is_optimal =
      path_.Follow(hierarchy, limit, &budget, &problem_, &side_);
  EXPECT_EQ(count.allocations(), 0);
  iterations_ = budget.iterations();
  return is_optimal;
}

bool PathBetween::MeetLevelsBeforeLast(const Hierarchy& hierarchy, int limit) {
  Budget budget({limit}, &no_clock_);
  Read(hierarchy);
  const CountMalloc count;
  problem_.Plan(hierarchy, hierarchy.num_levels());
  answer_ = path_.y();
  path_.Begin(answer_);
  ParametricSearch::Meeting meeting = path_.MeetLevelsBeforeLast(
      hierarchy, limit, &budget, &problem_, &side_, &answer_);
  bool is_met = meeting == ParametricSearch::Meeting::kMet;
  if (meeting == ParametricSearch::Meeting::kPostponed) {
    is_met = path_.PauseAtLevelsBeforeLast(hierarchy, limit, &budget, &problem_,
                                           &side_, &answer_);
  }
  EXPECT_EQ(count.allocations(), 0);
  return is_met;
}

void PathBetween::Read(const Hierarchy& hierarchy) {
  int failed_level;
  ASSERT_EQ(problem_.Read(hierarchy, &failed_level), Status::kOptimal);
}

void MakeLeading(int level, Hierarchy* hierarchy) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  InequalityBlock loose = hierarchy->AddInequalities(level, 1);
  loose.C.setOnes();
  loose.lower.setConstant(-kInfinity);
  loose.upper.setConstant(kInfinity);
}

ParametricSearch::Sides NoSides(const std::vector<LevelCapacity>& capacity) {
  ParametricSearch::Sides side;
  for (const LevelCapacity& level : capacity) {
    side.emplace_back(level.inequalities, Side::kNone);
  }
  return side;
}

}  // namespace poise
