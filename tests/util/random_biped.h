// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <random>

#include "robot/robot.h"

namespace poise {

/// A robot with two legs of six joints and a trunk with a chain of joints on
/// it, all of random size and mass (20 to 80 kg, legs of 0.5 to 1 m), that
/// stands on flat soles with bent knees at its nominal posture.
Robot MakeRandomBiped(std::mt19937* draw);

}  // namespace poise
