// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/tick_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "poise/tests/util/random_hierarchy.h"

namespace poise {
namespace {

TEST(TickFile, KeepsAllBits) {
  const HierarchyCase drawn = MakeRandomHierarchy(7);
  const std::string path = testing::TempDir() + "/ticks";
  WriteTicks({drawn.capacity, {drawn.hierarchy, drawn.hierarchy}}, path);
  const RecordedTicks read = ReadTicks(path);
  ASSERT_EQ(read.ticks.size(), 2u);
  for (const Hierarchy& tick : read.ticks) {
    ASSERT_EQ(tick.num_variables(), drawn.hierarchy.num_variables());
    ASSERT_EQ(tick.num_levels(), drawn.hierarchy.num_levels());
    for (int k = 0; k < tick.num_levels(); ++k) {
      EXPECT_EQ(tick.B(k), drawn.hierarchy.B(k));
      EXPECT_EQ(tick.b(k), drawn.hierarchy.b(k));
      EXPECT_EQ(tick.weight(k), drawn.hierarchy.weight(k));
      EXPECT_EQ(tick.C(k), drawn.hierarchy.C(k));
      EXPECT_EQ(tick.lower(k), drawn.hierarchy.lower(k));
      EXPECT_EQ(tick.upper(k), drawn.hierarchy.upper(k));
    }
  }
}

TEST(TickFile, RejectsFileThatEndsEarly) {
  const HierarchyCase drawn = MakeRandomHierarchy(7);
  const std::string path = testing::TempDir() + "/short_ticks";
  WriteTicks({drawn.capacity, {drawn.hierarchy}}, path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_THROW(ReadTicks(path), std::invalid_argument);
}

}  // namespace
}  // namespace poise
