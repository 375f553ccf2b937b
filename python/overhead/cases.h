// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "poise/robot/profile/profile.h"
#include "poise/robot/robot.h"

namespace poise {

/// A call that is timed, by the name of its Python function: "Tree.rnea".
struct TimedCase {
  std::string name;
  std::function<void()> call;
};

/// Tells the compiler that a value is used, so that its computation stays.
template <typename Value>
void Keep(const Value& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

// Each function appends the calls of some classes. The robot and the profile
// must outlive the calls.
void AddLieCases(std::vector<TimedCase>* cases);
void AddDynamicsCases(const Robot& robot, std::vector<TimedCase>* cases);
void AddConversionCases(const Robot& robot, std::vector<TimedCase>* cases);
void AddControlCases(const Robot& robot, const Profile& profile,
                     std::vector<TimedCase>* cases);
// urdf: the file of the robot. stand: a file of a scenario.
void AddSetupCases(const Robot& robot, const std::string& urdf,
                   const Profile& profile, const std::string& stand,
                   std::vector<TimedCase>* cases);

}  // namespace poise
