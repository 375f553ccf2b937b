// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/gait/force_priority.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "poise/robot/control/default_stack.h"
#include "poise/tests/util/load_humanoid.h"

namespace poise {
namespace {

double Weight(const Stack& stack, const std::string& name) {
  return stack.settings(*stack.Find(name)).weight;
}

std::vector<double> Weights(const Stack& stack) {
  std::vector<double> weights;
  for (int i = 0; i < stack.num_tasks(); ++i) {
    weights.push_back(stack.settings(i).weight);
  }
  return weights;
}

TEST(ForcePriority, RaisesForceLimitsAboveTheRestOfTheFeet) {
  Stack stack = MakeDefaultStack(LoadHumanoid(), {});
  ASSERT_TRUE(stack.SetWeight("cop", 3));
  ForcePriority priority;
  priority.Set(true, &stack);
  EXPECT_EQ(Weight(stack, "cop"), 3 * ForcePriority::kFactor);
  for (const char* name : {"friction", "unilateral", "yaw"}) {
    EXPECT_EQ(Weight(stack, name), ForcePriority::kFactor) << name;
  }
  EXPECT_EQ(Weight(stack, "contact"), 1);
}

TEST(ForcePriority, RestoresAllWeights) {
  Stack stack = MakeDefaultStack(LoadHumanoid(), {});
  ASSERT_TRUE(stack.SetWeight("friction", 0.5));
  const std::vector<double> before = Weights(stack);
  ForcePriority priority;
  // The second call must not save raised weights as the program's own.
  priority.Set(true, &stack);
  priority.Set(true, &stack);
  priority.Set(false, &stack);
  EXPECT_EQ(Weights(stack), before);
}

TEST(ForcePriority, KeepsWeightsInTheirRange) {
  Stack stack = MakeDefaultStack(LoadHumanoid(), {});
  ASSERT_TRUE(stack.SetWeight("yaw", Stack::kMostWeight / 2));
  ForcePriority priority;
  priority.Set(true, &stack);
  EXPECT_EQ(Weight(stack, "yaw"), Stack::kMostWeight);
}

TEST(ForcePriority, AcceptsAStackWithoutForceLimits) {
  Stack stack(1);
  ForcePriority priority;
  priority.Set(true, &stack);
  priority.Set(false, &stack);
  EXPECT_EQ(stack.num_tasks(), 0);
}

}  // namespace
}  // namespace poise
