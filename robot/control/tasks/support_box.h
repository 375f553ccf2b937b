// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "poise/math/pose.h"
#include "poise/robot/control/contacts.h"
#include "poise/robot/robot.h"

namespace poise {

/// Sides of the box around the soles in contact, in the axes of the mid-feet
/// frame.
enum SupportSide { kFront, kBack, kLeft, kRight };

/// Returns the distance from the frame's origin to one side of the box, m;
/// negative if no foot is in contact. Does not allocate.
double SupportReach(const std::vector<Foot>& feet,
                    const std::vector<ContactTick>& contacts,
                    const Pose& X_MidW, SupportSide side) noexcept;

}  // namespace poise
