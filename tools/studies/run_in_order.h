// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace poise {

/// Calls run(0) to run(count - 1), one per processor at a time. Passes each
/// result to use(i, result) on the calling thread, in the order of i, as soon
/// as the results before it are there. A processor that is done takes the next
/// run without waiting for the others.
///
/// @param run  called by several threads at the same time.
///
/// Throws the first exception, in the order of i, of run or use. Runs that have
/// not begun then do not begin.
template <typename Run, typename Use>
void RunInOrder(std::size_t count, const Run& run, const Use& use) {
  using Result = decltype(run(count));
  std::vector<std::packaged_task<Result()>> tasks;
  std::vector<std::future<Result>> results;
  for (std::size_t i = 0; i < count; ++i) {
    tasks.emplace_back([&run, i] { return run(i); });
    results.push_back(tasks.back().get_future());
  }
  std::atomic<std::size_t> next = 0;
  std::vector<std::future<void>> workers;
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t i = 0; i < std::min(cores, count); ++i) {
    workers.push_back(std::async(std::launch::async, [&] {
      for (std::size_t k; (k = next++) < count;) tasks[k]();
    }));
  }
  // After an exception, this stops the workers before they are waited for.
  struct Stop {
    std::atomic<std::size_t>* next;
    std::size_t count;
    ~Stop() { *next = count; }
  } stop{&next, count};
  for (std::size_t i = 0; i < count; ++i) use(i, results[i].get());
}

}  // namespace poise
