// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace poise {

/// Two benchmarks of one run, and so that ours / theirs is a ratio to quote.
struct Comparison {
  std::string ours;
  std::string theirs;
};

/// The main() of a benchmark that compares: runs the benchmarks that argv asks
/// for, nine times in random order unless it says otherwise, and prints the
/// fastest time of each, then the ratios. Where a benchmark says how many items
/// it processes, times are per item.
///
/// 0, or 1 where argv has an option that Google Benchmark does not know.
int CompareTimes(int argc, char** argv,
                 const std::vector<Comparison>& comparisons);

}  // namespace poise
