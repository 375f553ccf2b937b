// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/compare_times.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>

namespace poise {
namespace {

class FastestReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const auto items = run.counters.find("items_per_second");
      const double time = items == run.counters.end()
                              ? 1e9 * run.cpu_accumulated_time /
                                    static_cast<double>(run.iterations)
                              : 1e9 / items->second;
      // The name without the suffixes that flags add, such as "/repeats:9" or
      // "/min_time:0.100".
      std::string name = run.run_name.function_name;
      if (!run.run_name.args.empty()) name += "/" + run.run_name.args;
      const auto known = times_.emplace(name, time).first;
      known->second = std::min(known->second, time);
    }
  }

  void Print(const std::vector<Comparison>& comparisons) {
    for (const auto& [name, time] : times_) {
      std::printf("%-32s %10.1f ns\n", name.c_str(), time);
    }
    for (const Comparison& pair : comparisons) {
      const auto ours = times_.find(pair.ours);
      const auto theirs = times_.find(pair.theirs);
      if (ours == times_.end() || theirs == times_.end()) continue;
      std::printf("%s / %s = %.2f\n", pair.ours.c_str(), pair.theirs.c_str(),
                  ours->second / theirs->second);
    }
  }

 private:
  std::map<std::string, double> times_;  // In ns, by name.
};

}  // namespace

int CompareTimes(int argc, char** argv,
                 const std::vector<Comparison>& comparisons) {
  // The user's flags come last and override these: of two equal flags Google
  // Benchmark uses the last.
  std::string repetitions = "--benchmark_repetitions=9";
  std::string interleaving = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> flags(argv, argv + argc);
  flags.insert(flags.begin() + 1, {repetitions.data(), interleaving.data()});
  int num_flags = static_cast<int>(flags.size());
  benchmark::Initialize(&num_flags, flags.data());
  if (benchmark::ReportUnrecognizedArguments(num_flags, flags.data())) return 1;
  FastestReporter writer;
  benchmark::RunSpecifiedBenchmarks(&writer);
  writer.Print(comparisons);
  return 0;
}

}  // namespace poise
