// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Prints the time of each function of the package poise when C++ calls it, one
// line each: "Tree.rnea 2.31", in us.
//
// Usage: time_cpp URDF PROFILE ROUNDS
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "poise/python/overhead/cases.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/profile/profile.h"
#include "poise/robot/urdf/urdf.h"

namespace {

// Returns the time of `repetitions` calls, us.
double Time(const poise::TimedCase& timed, long repetitions) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (long i = 0; i < repetitions; ++i) timed.call();
  return std::chrono::duration<double, std::micro>(Clock::now() - start)
      .count();
}

// Returns the time of one call, us: the shortest of several rounds, because
// other programs make a round longer, never shorter. measure.py does the same.
double ShortestTime(const poise::TimedCase& timed, int rounds) {
  constexpr double kRound = 5000;  // us.
  long repetitions = 1;
  while (Time(timed, repetitions) < kRound && repetitions < 1000000) {
    repetitions *= 2;
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rounds; ++i) {
    const double time = Time(timed, repetitions) / double(repetitions);
    if (time < shortest) shortest = time;
  }
  return shortest;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: time_cpp URDF PROFILE ROUNDS\n";
    return 2;
  }
  const poise::Profile profile = poise::LoadProfile(argv[2]);
  const poise::Robot robot = poise::LoadStandingRobot(argv[1], profile);
  std::vector<poise::TimedCase> cases;
  poise::AddLieCases(&cases);
  poise::AddDynamicsCases(robot, &cases);
  poise::AddControlCases(robot, profile, &cases);
  for (const poise::TimedCase& timed : cases) {
    std::cout << timed.name << " " << ShortestTime(timed, std::atoi(argv[3]))
              << std::endl;
  }
  return 0;
}
