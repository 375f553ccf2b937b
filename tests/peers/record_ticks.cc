// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Records a sequence of hierarchies for compare:
//   record_ticks PUSH_FORCE HAS_LIMITS TORQUE_SCALE FILE
#include <exception>
#include <iostream>
#include <string>

#include "poise/tests/peers/tick_file.h"
#include "poise/tests/util/recorded_ticks.h"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "record_ticks: " << argc - 1 << " arguments, want 4: "
              << "PUSH_FORCE HAS_LIMITS TORQUE_SCALE FILE\n";
    return 2;
  }
  try {
    poise::RecordingConditions conditions;
    conditions.push_force = std::stod(argv[1]);
    conditions.has_limits = std::stoi(argv[2]) != 0;
    conditions.torque_scale = std::stod(argv[3]);
    poise::WriteTicks(poise::RecordTicks(conditions), argv[4]);
  } catch (const std::exception& error) {
    std::cerr << "record_ticks: " << error.what() << "\n";
    return 2;
  }
}
