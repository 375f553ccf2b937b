// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves recorded ticks with the solver that this program is built with:
//   measure FILE REPEATS
// Prints a line a tick: the CPU time of the fastest warm solve [us], 1 if the
// solver reports a solution or 0, then the cost and the floor of each level.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "poise/tests/peers/peer.h"
#include "poise/tests/peers/tick_file.h"

namespace poise {
namespace {

struct LevelResult {
  double cost;
  double floor;  // Costs below it count as this cost.
};

struct TickResult {
  double time = std::numeric_limits<double>::infinity();  // us.
  bool is_solved = false;
  std::vector<LevelResult> levels;
};

double ThreadTime() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) +
         1e-3 * static_cast<double>(now.tv_nsec);
}

double SquareIfFinite(double bound) {
  return std::isfinite(bound) ? bound * bound : 0;
}

// Returns the cost 1/2 (sum weight (B y + b)^2 + |slack|^2) from the rows
// alone. The floor is 1e-6 (1 + 1/2 sum weight b^2 + 1/2 sum bound^2).
LevelResult Evaluate(const Hierarchy& hierarchy, int k,
                     const Eigen::VectorXd& y) {
  double cost = 0, size = 0;
  for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
    const double b = hierarchy.b(k)[i], weight = hierarchy.weight(k)[i];
    const double residual = hierarchy.B(k).row(i).dot(y) + b;
    cost += weight * residual * residual;
    size += weight * b * b;
  }
  for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
    const double lower = hierarchy.lower(k)[i], upper = hierarchy.upper(k)[i];
    const double value = hierarchy.C(k).row(i).dot(y);
    // std::max would hide NaN.
    const double slack = value < lower    ? lower - value
                         : value <= upper ? 0
                                          : value - upper;
    cost += slack * slack;
    size += SquareIfFinite(lower) + SquareIfFinite(upper);
  }
  return {cost / 2, 1e-6 * (1 + size / 2)};
}

std::vector<TickResult> Measure(const RecordedTicks& recorded, int repeats) {
  const int n = recorded.ticks.front().num_variables();
  std::vector<TickResult> results(recorded.ticks.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const std::unique_ptr<Peer> peer = MakePeer(n, recorded.capacity);
    for (size_t i = 0; i < results.size(); ++i) {
      const Hierarchy& hierarchy = recorded.ticks[i];
      peer->Load(hierarchy);
      const double start = ThreadTime();
      const bool is_solved = peer->Solve();
      const double time = ThreadTime() - start;
      results[i].time = std::min(results[i].time, time);
      if (repeat > 0) continue;
      results[i].is_solved = is_solved;
      for (int k = 0; k < hierarchy.num_levels(); ++k) {
        results[i].levels.push_back(Evaluate(hierarchy, k, peer->y()));
      }
    }
  }
  return results;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "measure: " << argc - 1
              << " arguments, want 2: FILE REPEATS\n";
    return 2;
  }
  try {
    const poise::RecordedTicks recorded = poise::ReadTicks(argv[1]);
    for (const poise::TickResult& tick :
         poise::Measure(recorded, std::stoi(argv[2]))) {
      std::printf("%.3f %d", tick.time, tick.is_solved);
      for (const poise::LevelResult& level : tick.levels) {
        std::printf(" %.17g %.17g", level.cost, level.floor);
      }
      std::printf("\n");
    }
  } catch (const std::exception& error) {
    std::cerr << "measure: " << error.what() << "\n";
    return 2;
  }
}
