// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Solves recorded ticks with the solver that this program is built with:
//   measure FILE
// Prints a line a tick: the CPU time of the warm solve [us], 1 if the solver
// reports a solution or 0, then the cost and the floor of each level.
#include <time.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <vector>

#include "poise/tests/peers/peer.h"
#include "poise/tests/peers/tick_file.h"

namespace poise {
namespace {

struct LevelResult {
  double cost;
  double floor;  // Costs below it count as this cost.
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

void Measure(const RecordedTicks& recorded) {
  const int n = recorded.ticks.front().num_variables();
  const std::unique_ptr<Peer> peer = MakePeer(n, recorded.capacity);
  for (const Hierarchy& hierarchy : recorded.ticks) {
    peer->Load(hierarchy);
    const double start = ThreadTime();
    const bool is_solved = peer->Solve();
    const double time = ThreadTime() - start;
    std::printf("%.3f %d", time, is_solved);
    for (int k = 0; k < hierarchy.num_levels(); ++k) {
      const LevelResult level = Evaluate(hierarchy, k, peer->y());
      std::printf(" %.17g %.17g", level.cost, level.floor);
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "measure: " << argc - 1 << " arguments, want 1: FILE\n";
    return 2;
  }
  try {
    poise::Measure(poise::ReadTicks(argv[1]));
  } catch (const std::exception& error) {
    std::cerr << "measure: " << error.what() << "\n";
    return 2;
  }
}
