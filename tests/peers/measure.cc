// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves recorded ticks with the solver that this program is built with:
//   measure FILE [SECONDS]
// Prints a line a tick: the CPU time of the solve [us], 1 if the solver reports
// a solution or 0, then the cost and the floor of each level. The first solve
// is cold, the others are warm.
//
// With SECONDS, the ticks are solved in 3 to 50 passes until the time is over.
// Each pass begins with a cold solve, and each tick has the time of its fastest
// pass.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "poise/tests/peers/peer.h"
#include "poise/tests/peers/thread_time.h"
#include "poise/tests/peers/tick_file.h"

namespace poise {
namespace {

struct LevelResult {
  double cost;
  double floor;  // Costs below it count as this cost.
};

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

struct TickResult {
  double time;  // [us]
  bool is_solved;
  std::vector<LevelResult> levels;
};

std::vector<TickResult> SolveTicks(const RecordedTicks& recorded, Peer* peer) {
  std::vector<TickResult> results;
  for (const Hierarchy& hierarchy : recorded.ticks) {
    peer->Load(hierarchy);
    const double start = ThreadTime();
    const bool is_solved = peer->Solve();
    results.push_back({ThreadTime() - start, is_solved, {}});
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      results.back().levels.push_back(Evaluate(hierarchy, k, peer->y()));
    }
  }
  return results;
}

// Returns the results of the first pass, with the time of the fastest pass. A
// tick is solved if all passes solve it.
std::vector<TickResult> SolveInPasses(const RecordedTicks& recorded,
                                      double seconds, Peer* peer) {
  constexpr int kFewestPasses = 3, kMostPasses = 50;
  peer->AllowMoreIterations();
  const double end = ThreadTime() + 1e6 * seconds;
  std::vector<TickResult> results = SolveTicks(recorded, peer);
  for (int pass = 1; pass < kMostPasses; ++pass) {
    if (pass >= kFewestPasses && ThreadTime() > end) break;
    peer->Forget();
    const std::vector<TickResult> again = SolveTicks(recorded, peer);
    for (size_t i = 0; i < again.size(); ++i) {
      results[i].time = std::min(results[i].time, again[i].time);
      results[i].is_solved = results[i].is_solved && again[i].is_solved;
    }
  }
  return results;
}

void Print(const std::vector<TickResult>& results) {
  for (const TickResult& tick : results) {
    std::printf("%.3f %d", tick.time, tick.is_solved);
    for (const LevelResult& level : tick.levels) {
      std::printf(" %.17g %.17g", level.cost, level.floor);
    }
    std::printf("\n");
  }
}

void Measure(int argc, char** argv) {
  const RecordedTicks recorded = ReadTicks(argv[1]);
  const int n = recorded.ticks.front().num_variables();
  const std::unique_ptr<Peer> peer = MakePeer(n, recorded.capacity);
  Print(argc == 2 ? SolveTicks(recorded, peer.get())
                  : SolveInPasses(recorded, std::stod(argv[2]), peer.get()));
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::cerr << "measure: " << argc - 1
              << " arguments, want 1 or 2: FILE [SECONDS]\n";
    return 2;
  }
  try {
    poise::Measure(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "measure: " << error.what() << "\n";
    return 2;
  }
}
