// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Times the functions of the package poise when C++ calls them. Prints their
// names in one line, and then answers each name on the standard input with the
// time of a call, us.
//
// Usage: time_cpp URDF PROFILE SCENARIO
#include <chrono>
#include <iostream>
#include <map>
#include <string>
#include <vector>

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

// Returns how many calls take 5 ms.
long CountRepetitions(const poise::TimedCase& timed) {
  constexpr double kRound = 5000;  // us.
  long repetitions = 1;
  while (Time(timed, repetitions) < kRound && repetitions < 1000000) {
    repetitions *= 2;
  }
  return repetitions;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: time_cpp URDF PROFILE SCENARIO\n";
    return 2;
  }
  const poise::Profile profile = poise::LoadProfile(argv[2]);
  const poise::Robot robot = poise::LoadStandingRobot(argv[1], profile);
  std::vector<poise::TimedCase> cases;
  poise::AddLieCases(&cases);
  poise::AddDynamicsCases(robot, &cases);
  poise::AddConversionCases(robot, &cases);
  poise::AddControlCases(robot, profile, &cases);
  poise::AddSetupCases(robot, argv[1], profile, argv[3], &cases);
  std::map<std::string, const poise::TimedCase*> by_name;
  for (const poise::TimedCase& timed : cases) {
    by_name[timed.name] = &timed;
    std::cout << timed.name << " ";
  }
  std::cout << std::endl;
  std::map<std::string, long> repetitions;
  for (std::string name; std::cin >> name;) {
    const poise::TimedCase& timed = *by_name.at(name);
    long& count = repetitions[name];
    if (count == 0) count = CountRepetitions(timed);
    std::cout << Time(timed, count) / double(count) << std::endl;
  }
  return 0;
}
