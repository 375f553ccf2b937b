// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/run_in_order.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace poise {
namespace {

TEST(RunInOrder, PassesResultsInOrder) {
  constexpr std::size_t kCount = 50;
  std::vector<std::atomic<int>> calls(kCount);
  std::vector<std::string> results;
  RunInOrder(
      kCount,
      [&](std::size_t i) {
        ++calls[i];
        // Every seventh run is slow, so that later runs end before it.
        if (i % 7 == 0) {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return std::to_string(i);
      },
      [&](std::size_t i, const std::string& result) {
        EXPECT_EQ(i, results.size());
        results.push_back(result);
      });
  ASSERT_EQ(results.size(), kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(results[i], std::to_string(i));
    EXPECT_EQ(calls[i], 1);
  }
}

// With one processor, the first run cannot wait for the others.
TEST(RunInOrder, GoesOnWhileARunIsSlow) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP();
  constexpr int kCount = 20;
  std::atomic<int> ended = 0;
  int ended_before_first = -1;
  RunInOrder(
      kCount,
      [&](std::size_t i) {
        while (i == 0 && ended < kCount - 1) std::this_thread::yield();
        return ended++;
      },
      [&](std::size_t i, int place) {
        if (i == 0) ended_before_first = place;
      });
  EXPECT_EQ(ended_before_first, kCount - 1);
}

TEST(RunInOrder, AcceptsNoRuns) {
  RunInOrder(
      0, [](std::size_t i) { return i; },
      [](std::size_t, std::size_t) { ADD_FAILURE(); });
}

TEST(RunInOrder, ThrowsTheExceptionOfARun) {
  std::size_t used = 0;
  EXPECT_THROW(RunInOrder(
                   100,
                   [](std::size_t i) {
                     if (i == 3) throw std::invalid_argument("3");
                     return i;
                   },
                   [&](std::size_t, std::size_t) { ++used; }),
               std::invalid_argument);
  EXPECT_EQ(used, 3u);
}

// The first result throws, the second run waits until then. The others must not
// begin: two processors have at most one run each in hand.
TEST(RunInOrder, BeginsNoRunAfterAnException) {
  std::atomic<std::size_t> begun = 0;
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  EXPECT_THROW(RunInOrder(
                   100 * cores,
                   [&](std::size_t i) {
                     ++begun;
                     if (i == 0) throw std::invalid_argument("0");
                     std::this_thread::sleep_for(std::chrono::milliseconds(20));
                     return i;
                   },
                   [](std::size_t, std::size_t) {}),
               std::invalid_argument);
  EXPECT_LT(begun, 50 * cores);
}

}  // namespace
}  // namespace poise
