// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/aligned_doubles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace poise {
namespace {

constexpr std::uintptr_t kCacheLine = 64;  // Bytes, on all processors with AVX.

bool BeginsALine(const AlignedDoubles& x) {
  return reinterpret_cast<std::uintptr_t>(x.data()) % kCacheLine == 0;
}

// Vectors of all small sizes live at the same time, so that they lie one after
// the other.
TEST(AlignedDoubles, BeginAtACacheLine) {
  std::vector<AlignedDoubles> all;
  for (int size = 1; size <= 100; ++size) all.emplace_back(size, size);
  for (const AlignedDoubles& x : all) {
    EXPECT_TRUE(BeginsALine(x)) << x.size();
    for (const double entry : x) EXPECT_EQ(entry, x.size());
  }
}

TEST(AlignedDoubles, StayAlignedWhenTheyGrowAndMove) {
  AlignedDoubles x;
  for (int size = 1; size <= 100; ++size) {
    x.push_back(size);
    const AlignedDoubles copy = x;
    EXPECT_TRUE(BeginsALine(x) && BeginsALine(copy)) << size;
    EXPECT_EQ(copy, x);
  }
  AlignedDoubles assigned(3, 0.0);
  assigned = std::move(x);
  EXPECT_TRUE(BeginsALine(assigned));
  EXPECT_EQ(assigned.size(), 100u);
  EXPECT_EQ(assigned.back(), 100);
}

}  // namespace
}  // namespace poise
