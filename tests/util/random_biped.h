// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <rapidcheck.h>

#include <Eigen/Core>
#include <iosfwd>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// What a biped is made from.
struct BipedCase {
  double mass = 50;                    ///< kg.
  double shank = 0.4, thigh = 0.4;     ///< Lengths, m.
  double ankle = 0.08, hip = 0.1;      ///< Height; to each side, m.
  double trunk = 0.4;                  ///< Length, m.
  double knee = 0.6;                   ///< Its angle, standing, rad.
  double room = 2.5;                   ///< Of a joint, to each side, rad.
  std::vector<Eigen::Vector3d> chain;  ///< Axes of joints on the trunk.
};

/// A robot with two legs of six joints, a trunk and a chain of joints on it,
/// that stands on flat soles with bent knees at its nominal posture.
Robot MakeBiped(const BipedCase& from);

/// Bipeds of 20 to 80 kg, legs of 0.5 to 1 m and up to 7 joints in the chain.
/// They shrink to fewer joints and to the sizes above.
rc::Gen<BipedCase> Bipeds();

/// How a failure prints it.
void showValue(const BipedCase& biped, std::ostream& os);

}  // namespace poise
