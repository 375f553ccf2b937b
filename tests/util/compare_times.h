// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace poise {

/// Two benchmarks of one run whose ratio of times, ours / theirs, is printed.
struct Comparison {
  std::string ours;
  std::string theirs;
};

/// Main function of a benchmark that compares. Runs the benchmarks that argv
/// selects, by default nine times in random order. Prints the fastest time of
/// each, then the ratios. If a benchmark reports processed items, its time is
/// per item.
///
/// Returns 0, or 1 if argv has an option that Google Benchmark does not know.
int CompareTimes(int argc, char** argv,
                 const std::vector<Comparison>& comparisons);

}  // namespace poise
