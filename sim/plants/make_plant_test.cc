// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/make_plant.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>

#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

TEST(MakePlant, MakesADifferentPlantForEachName) {
  const Robot block = MakeBlock({0.2, 0.2, 0.1}, 5);
  const auto bullet = MakePlant(block, "bullet", {});
  const auto mujoco = MakePlant(block, "mujoco", {});
  const Plant& first = *bullet;
  const Plant& second = *mujoco;
  EXPECT_NE(typeid(first), typeid(second));
  for (const std::string& name : PlantNames()) {
    EXPECT_TRUE(IsPlant(name));
    EXPECT_NE(MakePlant(block, name, {}), nullptr);
  }
}

// An unknown name must not silently give the default plant.
TEST(MakePlant, RejectsAnUnknownNameAndListsTheKnownOnes) {
  for (const char* name : {"mars", "", "Bullet", "mujoco "}) {
    EXPECT_FALSE(IsPlant(name));
    try {
      MakePlant(MakeBlock({0.2, 0.2, 0.1}, 5), name, {});
      FAIL() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "plant.kind is '" + std::string(name) +
                                  "', must be bullet or mujoco");
    }
  }
}

}  // namespace
}  // namespace poise
