// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Writes a problem of the format hqp-1, and changed copies, for compare:
//   hqp_ticks PROBLEM.json NUM_CHANGED CHANGES_BOUNDS FILE
#include <exception>
#include <iostream>
#include <string>

#include "poise/tests/peers/changed_ticks.h"
#include "poise/tests/peers/tick_file.h"
#include "poise/tools/commands/hqp/solve_files.h"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "hqp_ticks: " << argc - 1 << " arguments, want 4: "
              << "PROBLEM.json NUM_CHANGED CHANGES_BOUNDS FILE\n";
    return 2;
  }
  try {
    const poise::HqpProblem problem = poise::LoadHqp(argv[1]);
    poise::WriteTicks(
        poise::MakeChangedTicks(problem.hierarchy, problem.capacity,
                                std::stoi(argv[2]), std::stoi(argv[3]) != 0),
        argv[4]);
  } catch (const std::exception& error) {
    std::cerr << "hqp_ticks: " << error.what() << "\n";
    return 2;
  }
}
