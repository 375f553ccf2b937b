// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Records the states of our humanoid in closed loop for compare:
//   record_states PUSH_FORCE HAS_LIMITS FILE
#include <exception>
#include <iostream>
#include <string>

#include "poise/tests/peers/state_file.h"
#include "poise/tests/util/recorded_ticks.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "record_states: " << argc - 1
              << " arguments, want 3: PUSH_FORCE HAS_LIMITS FILE\n";
    return 2;
  }
  try {
    poise::RecordingConditions conditions;
    conditions.push_force = std::stod(argv[1]);
    conditions.has_limits = std::stoi(argv[2]) != 0;
    // A controller that replays the states starts where this one did.
    conditions.begin = 0;
    poise::WriteStates(poise::RecordStates(conditions), argv[3]);
  } catch (const std::exception& error) {
    std::cerr << "record_states: " << error.what() << "\n";
    return 2;
  }
}
