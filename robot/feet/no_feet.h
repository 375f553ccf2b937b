// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <stdexcept>
#include <string>

namespace poise {

/// Why FindFeet() found no two feet, as far as the user needs other advice than
/// to give the feet in a profile. kManyLegs: the robot stands on more than two
/// limbs, as a quadruped does. kNoEffort: joints of a leg have an effort limit
/// of 0.
enum class FeetDefect { kManyLegs, kNoEffort };

/// The error of FindFeet() about such a robot.
class NoFeet : public std::invalid_argument {
 public:
  NoFeet(FeetDefect defect, const std::string& what)
      : std::invalid_argument(what), defect_(defect) {}

  FeetDefect defect() const { return defect_; }

 private:
  FeetDefect defect_;
};

}  // namespace poise
