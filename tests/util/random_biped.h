// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <rapidcheck.h>

#include <Eigen/Core>
#include <iosfwd>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Parameters of a biped.
struct BipedCase {
  double mass = 50;                    ///< kg.
  double shank = 0.4, thigh = 0.4;     ///< Lengths, m.
  double ankle = 0.08, hip = 0.1;      ///< Height; half distance of hips, m.
  double trunk = 0.4;                  ///< Length, m.
  double knee = 0.6;                   ///< Knee angle when standing, rad.
  double room = 2.5;                   ///< Joint range to each side, rad.
  std::vector<Eigen::Vector3d> chain;  ///< Joint axes, from the trunk on.
};

/// Makes a robot with two legs of six joints each, a trunk, and a chain of
/// joints on the trunk. Its nominal posture stands on flat soles with bent
/// knees.
Robot MakeBiped(const BipedCase& from);

/// Draws bipeds of 20 to 80 kg with legs of 0.5 to 1 m and up to 7 joints in
/// the chain. They shrink to fewer joints and to the default sizes of
/// BipedCase.
rc::Gen<BipedCase> Bipeds();

/// RapidCheck prints a failing case by this function.
void showValue(const BipedCase& biped, std::ostream& os);

}  // namespace poise
