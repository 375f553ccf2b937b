// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string_view>

namespace poise {

/// Answer of Gait::StepTo().
enum class StepAnswer {
  kAccepted,
  kUnknownFoot,
  kStopped,        ///< By Gait::Stop().
  kSteps,          ///< A step is on its way.
  kNotOnBothFeet,  ///< The controller has lifted, lost or released a foot.
  kPushed,         ///< A push acts.
  kMoves,          ///< The center of mass is too fast.
  kFailSafe,       ///< The controller is in fail-safe.
  kNotANumber,     ///< The place is not finite.
  kOutOfReach,     ///< The leg does not reach the place.
};

/// Returns the answer in words, such as "the leg does not reach the place".
constexpr std::string_view Describe(StepAnswer answer) {
  switch (answer) {
    case StepAnswer::kAccepted:
      return "accepted";
    case StepAnswer::kUnknownFoot:
      return "the robot does not have this foot";
    case StepAnswer::kStopped:
      return "the gait is stopped";
    case StepAnswer::kSteps:
      return "the robot makes another step";
    case StepAnswer::kNotOnBothFeet:
      return "the robot does not stand on both feet";
    case StepAnswer::kPushed:
      return "a push acts on the robot";
    case StepAnswer::kMoves:
      return "the center of mass moves faster than 0.05 m/s";
    case StepAnswer::kFailSafe:
      return "the controller is in fail-safe";
    case StepAnswer::kNotANumber:
      return "the place is not a finite number";
    case StepAnswer::kOutOfReach:
      return "the leg does not reach the place, or the feet would cross";
  }
  return "";
}

}  // namespace poise
